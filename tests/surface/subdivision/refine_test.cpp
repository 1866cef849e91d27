#include "bake/surface/subdivision/refiner.h"
#include "mesh/file/mesh_files.h"
#include "oracle/limit_masks.h"
#include "surface/subdivision/cages.h"
#include <map>
#include <opensubdiv/far/primvarRefiner.h>

using namespace bake;
using namespace bake_tests;
using namespace OpenSubdiv;

namespace {

void keep_tags(const Far::TopologyLevel& level, SubdivisionTags& tags) {
    for (int e = 0; e < level.GetNumEdges(); ++e) {
        const float sharpness = level.GetEdgeSharpness(e);
        if (!(sharpness > 0) || level.GetEdgeFaces(e).size() < 2) continue; // borders are always sharp
        const Far::ConstIndexArray ends = level.GetEdgeVertices(e);
        tags.creases.push_back({std::uint32_t(ends[0]), std::uint32_t(ends[1]), sharpness});
    }
    for (int v = 0; v < level.GetNumVertices(); ++v)
        if (const float sharpness = level.GetVertexSharpness(v); sharpness > 0)
            tags.corners.push_back({std::uint32_t(v), sharpness});
}

// Values of the last level.
template <class V>
std::vector<Weighted<V>> last_values(const Far::TopologyRefiner& refiner, std::vector<Weighted<V>> values,
                                     bool face_varying) {
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    for (int i = 1; i <= refiner.GetMaxLevel(); ++i) {
        const Far::TopologyLevel& level = refiner.GetLevel(i);
        std::vector<Weighted<V>> next(std::size_t(face_varying ? level.GetNumFVarValues(0) : level.GetNumVertices()));
        if (face_varying) primvars.InterpolateFaceVarying(i, values, next, 0);
        else primvars.Interpolate(i, values, next);
        values = std::move(next);
    }
    return values;
}

// The cage after uniform refinement with the topology, tags and uv rules of the limit surface. Keeps uvs, materials, groups,
// and tags with their remaining sharpness.
Mesh refine(const Mesh& cage, const SubdivisionOptions& options, int levels) {
    UvValues uvs = uv_values(cage);
    const std::unique_ptr<Far::TopologyRefiner> refiner =
        make_refiner(refiner_input(cage, uvs), cage.tags.boundary, options);
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    const Far::TopologyLevel& last = refiner->GetLevel(levels);

    std::vector<Weighted<Vec3d>> positions(cage.positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i].value = Vec3d(cage.positions[i]);
    Mesh mesh;
    for (const auto& p : last_values(*refiner, std::move(positions), false)) mesh.positions.emplace_back(p.value);
    const bool has_uv = !uvs.corner.empty();
    if (has_uv)
        for (const auto& uv : last_values(*refiner, std::move(uvs.values), true)) mesh.uvs.emplace_back(uv.value);

    std::vector<std::uint32_t> origin(std::size_t(last.GetNumFaces()));
    for (int f = 0; f < last.GetNumFaces(); ++f) {
        Far::Index parent = f;
        for (int i = levels; i > 0; --i) parent = refiner->GetLevel(i).GetFaceParentFace(parent);
        origin[std::size_t(f)] = std::uint32_t(parent);
        const Far::ConstIndexArray corners = last.GetFaceVertices(f);
        for (const Far::Index v : corners) mesh.corner_position.push_back(std::uint32_t(v));
        if (has_uv)
            for (const Far::Index v : last.GetFaceFVarValues(f, 0)) mesh.corner_uv.push_back(std::uint32_t(v));
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
    }
    mesh.materials = cage.materials;
    mesh.groups = cage.groups;
    for (const std::uint32_t f : origin) {
        if (!cage.face_material.empty()) mesh.face_material.push_back(cage.face_material[f]);
        if (!cage.face_group.empty()) mesh.face_group.push_back(cage.face_group[f]);
    }
    mesh.tags.boundary = cage.tags.boundary;
    keep_tags(last, mesh.tags);
    return mesh;
}

// Largest distance from a point of `a` to the nearest point of `b`, or of the reverse direction.
double distance_of_points(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b, double cell) {
    using Key = std::tuple<long, long, long>;
    const auto one_way = [cell](const std::vector<Vec3f>& from, const std::vector<Vec3f>& to) {
        const auto key = [cell](const Vec3f& p, int i, int j, int k) {
            return Key{std::lround(double(p.x) / cell) + i, std::lround(double(p.y) / cell) + j,
                       std::lround(double(p.z) / cell) + k};
        };
        std::multimap<Key, Vec3f> grid;
        for (const Vec3f& p : to) grid.emplace(key(p, 0, 0, 0), p);
        double worst = 0;
        for (const Vec3f& p : from) {
            double nearest = INFINITY;
            for (int i = -1; i <= 1; ++i)
                for (int j = -1; j <= 1; ++j)
                    for (int k = -1; k <= 1; ++k) {
                        const auto [begin, end] = grid.equal_range(key(p, i, j, k));
                        for (auto q = begin; q != end; ++q)
                            nearest = std::min(nearest, glm::distance(Vec3d(q->second), Vec3d(p)));
                    }
            worst = std::max(worst, nearest);
        }
        return worst;
    };
    return std::max(one_way(a, b), one_way(b, a));
}

Mesh tagged_box(bool triangles) {
    Mesh cage = box();
    cage.tags.creases = {{4, 5, 2.3f}, {5, 6, 10}, {1, 2, 1}};
    cage.tags.corners = {{3, 1.5f}};
    if (triangles) cage = in_triangles(cage);
    give_each_face_a_chart(cage);
    return cage;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("refine: faces keep uvs, materials and groups") {
        Mesh cage = tagged_box(false);
        cage.materials = {"a", "b"};
        cage.face_material = {0, 1, 0, 1, no_index, 1};
        cage.groups = {"g"};
        cage.face_group = {0, 0, 0, no_index, 0, 0};
        const Mesh fine = refine(cage, {}, 2);
        REQUIRE(fine.faces() == 6 * 16);
        CHECK(fine.positions.size() == 6 * 16 + 2);
        CHECK(fine.materials == cage.materials);
        CHECK(fine.groups == cage.groups);
        for (std::uint32_t f = 0; f < fine.faces(); ++f) {
            CHECK(fine.face_material[f] == cage.face_material[f / 16]);
            CHECK(fine.face_group[f] == cage.face_group[f / 16]);
        }
        CHECK(fine.uvs.size() == 6 * 25); // each face has its own chart
        CHECK(fine.corner_uv.size() == fine.corners());
        const Mesh same = refine(cage, {}, 0);
        CHECK(same_corners(same, cage));
    }

    TEST_CASE("refine: two steps give the same mesh as one, with tags") {
        for (const bool triangles : {false, true}) {
            const SubdivisionOptions options{triangles ? Scheme::loop : Scheme::catmark};
            const Mesh cage = tagged_box(triangles);
            const Mesh once = refine(cage, options, 3), twice = refine(refine(cage, options, 1), options, 2);
            REQUIRE(once.positions.size() == twice.positions.size());
            CHECK(distance_of_points(once.positions, twice.positions, 0.1) < 4e-7); // rounded to float in between
        }
    }
}

TEST_SUITE("oracle") {
    TEST_CASE("refine: levels of both schemes, with creases and corners, agree with the subdivision rules") {
        for (const bool triangles : {false, true}) {
            const Scheme scheme = triangles ? Scheme::loop : Scheme::catmark;
            for (Mesh cage : {tagged_box(triangles), triangles ? in_triangles(dome(5)) : dome(5)}) {
                oracle::Cage expected = oracle::cage_of(cage, scheme);
                for (int level = 1; level <= 3; ++level) {
                    expected = oracle::subdivide(expected);
                    const Mesh fine = refine(cage, {scheme}, level);
                    REQUIRE(fine.positions.size() == expected.points.size());
                    std::vector<Vec3f> points;
                    for (const Vec3d& p : expected.points) points.emplace_back(p);
                    CHECK(distance_of_points(fine.positions, points, 0.1) <
                          5e-7); // both rounded to float, sizes up to 3
                }
            }
        }
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("refine: Spot's quad mesh is two levels of its cage") {
        const auto folder = test::shared_data() / "meshes/spot";
        const Mesh fine = refine(read_mesh((folder / "spot_control_mesh.obj").string()), {}, 2);
        const Mesh expected = read_mesh((folder / "spot_quadrangulated.obj").string());
        CHECK(fine.faces() == expected.faces());
        const double distance = distance_of_points(fine.positions, expected.positions, 0.02);
        MESSAGE("Spot: ", distance);
        CHECK(distance < 1e-5); // the file has five or six digits
    }

    TEST_CASE("refine: eight levels agree with files written by OpenSubdiv's Hbr") {
        const auto folder = test::shared_data() / "meshes/opensubdiv/reference";
        const auto level = [&](const std::string& name, int i) {
            return read_mesh((folder / (name + "_level" + std::to_string(i) + ".obj")).string());
        };
        // Level 0 of the files is the first refinement of the shape. The files have no tags: the dart has sharp corners and
        // a crease of sharpness 2, after one refinement 1, from (1, -1) on its border to its centre.
        for (const std::string name : {"catmark_cube", "catmark_dart_edgecorner"}) {
            Mesh cage = level(name, 0);
            if (name == "catmark_dart_edgecorner") {
                std::vector<std::uint32_t> chain;
                for (const float x : {1.0f, 0.75f, 0.5f, 0.25f, 0.0f})
                    for (std::uint32_t v = 0; v < cage.positions.size(); ++v)
                        if (glm::distance(Vec2f(cage.positions[v]), Vec2f(x, -x)) < 1e-5f) chain.push_back(v);
                REQUIRE(chain.size() == 5);
                for (std::size_t i = 0; i < 4; ++i) cage.tags.creases.push_back({chain[i], chain[i + 1], 1});
                cage.tags.boundary = SubdivisionTags::Boundary::edge_and_corner;
            }
            for (int i = 0; i < 4; ++i) {
                const Mesh expected = level(name, i), fine = refine(cage, {}, i);
                const double distance = distance_of_points(fine.positions, expected.positions, 0.05);
                MESSAGE(name, " ", i, ": ", distance / diagonal(bounds(expected)));
                CHECK(distance <= 1e-6 * diagonal(bounds(expected)));
            }
        }
    }
}
