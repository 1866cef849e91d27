// Closed surfaces stay closed: OpenMesh's half-edges, which represent oriented manifolds only, accept each face of the
// displaced mesh, and no edge is a boundary.
#include "mesh/by_openmesh.h"
#include "relief/displace/watertight.h"

using namespace bake;
using namespace bake::test;

namespace {

void check_closed(const BaseSurface& base) {
    for (const Seam seam : {Seam::average, Seam::owner, Seam::blend})
        for (const Rates& rates : {uniform(2), mixed_rates(base.mesh(), 60)}) {
            CAPTURE(int(seam));
            const Mesh mesh = displaced_by_noise(base, rates, seam).displaced.mesh;
            const ByOpenMesh faces = by_openmesh(mesh);
            CHECK(mesh.faces() > base.mesh().faces());
            CHECK(faces.refused == 0);
            CHECK(faces.boundary_edges() == 0);
        }
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("displace: a closed mesh stays a closed manifold") {
        check_closed(BaseSurface(cube()));
        check_closed(BaseSurface(cube(true)));
        check_closed(BaseSurface(oracle::torus_mesh(8, 5, true)));
    }

    TEST_CASE("displace: the limit surface of a closed cage stays a closed manifold") {
        check_closed(BaseSurface(cube(), SubdivisionOptions{}));
    }

    TEST_CASE("displace: closed shapes stay closed manifolds, across poles and the borders of their charts") {
        for (const char* shape : {"sphere:R=1", "torus:R=2,r=0.5"}) {
            CAPTURE(shape);
            check_closed(BaseSurface(ParametricSurface(shape), 12, 6));
        }
    }

} // TEST_SUITE
