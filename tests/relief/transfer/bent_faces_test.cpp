// Smooth normals that lean so far from their faces that rays along them see the faces from behind.
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

/// The unit square, shaded with this normal.
Mesh shaded(const Vec3f& n) {
    Mesh mesh = unit_plane();
    for (Vec3f& each : mesh.normals) each = glm::normalize(n);
    return mesh;
}

Mesh wide_plane() {
    Mesh mesh;
    add_patch(mesh, 1, 1, [](double s, double t) { return PatchPoint{{3 * s - 1, 3 * t - 1, 0.01}, {0, 0, 1}, {}}; });
    return mesh;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("transfer: where smooth normals see a face from behind, rays that find nothing are cast from its front") {
        JobOptions options = job_options(8, 8);
        options.reach = Reach{0.04f, 0.04f, 0}; // .0136 above the facet, in the second try
        const Job bent(shaded({1, 0, -0.2f}), {wide_plane()}, options);
        CHECK(bent.report().missed == 0);
        CHECK(bent.report().hit == 64);
        const Job upright(shaded({1, 0, 2}), {wide_plane()}, options);
        CHECK(upright.report().missed == 0);
        CHECK(upright.report().rays == 64); // no second try
    }

    TEST_CASE("casting: facing() is 80 degrees off the facet, in the plane of both, and nothing for other directions") {
        const Mesh mesh = shaded({1, 0, -0.2f}), other = shaded({1, 0, 1});
        const MeshSurface surface = make_mesh_surface(mesh), upright = make_mesh_surface(other);
        const Reach reach{0.2f, 0.1f, 0};
        const auto cast = Casting(surface, CastBy::blend, constant_reach(surface, reach)).facing({0, 0.3f, 0.3f});
        REQUIRE(cast);
        CHECK(glm::length(cast->inward) == doctest::Approx(1));
        CHECK(-cast->inward.z == doctest::Approx(0.17));
        CHECK(cast->inward.x < -0.9f);
        CHECK((cast->start + 0.2f * cast->inward).z == doctest::Approx(0).epsilon(1e-6)); // still through the mesh
        CHECK(!Casting(upright, CastBy::blend, constant_reach(upright, reach)).facing({0, 0.3f, 0.3f}));
        CHECK(!Casting(surface, mesh, "cage").facing({0, 0.3f, 0.3f}));
    }

} // TEST_SUITE
