// SubdivisionSurface compared with limit masks, on small cages and on real ones.
#include "bake/surface/subdivision/subdivision.h"
#include "mesh/file/mesh_files.h"
#include "oracle/limit_masks.h"
#include "oracle/surfaces.h"
#include "surface/subdivision/cages.h"

using namespace bake;
using namespace bake_tests;

namespace {

struct Worst {
    double position = 0; ///< relative to the diagonal
    double normal_deg = 0;
    std::size_t points = 0, normals = 0;
    bool good() const {
        return points > 0 && normals > 0 && position <= 1e-6 && normal_deg <= 0.01;
    } ///< the documented bounds
};

// Errors at the corners of some faces of a level. Normals are skipped where the ring is smaller than `least_ring` of the
// diagonal.
template <class Wanted>
void compare(const SubdivisionSurface& surface, const oracle::Cage& level, double diagonal, double least_ring,
             const Wanted& wanted, Worst& worst) {
    const oracle::LimitMasks masks(level);
    for (std::uint32_t f = 0; f < level.faces.size(); ++f) {
        const oracle::Cage::Face& face = level.faces[f];
        if (!wanted(face)) continue;
        std::vector<LimitPoint> points(face.st.size());
        surface.evaluate(face.patch, face.st, Derivatives::first, points);
        for (std::uint32_t k = 0; k < face.vertex.size(); ++k) {
            const oracle::Limit limit = masks.at(f, k);
            worst.position = std::max(worst.position, glm::distance(points[k].p, limit.p) / diagonal);
            ++worst.points;
            if (!limit.normal || glm::length(*limit.normal) < least_ring * least_ring * diagonal * diagonal) continue;
            const double angle = oracle::angle_deg(*limit.normal, glm::cross(points[k].p_s, points[k].p_t));
            worst.normal_deg = std::max(worst.normal_deg, angle);
            ++worst.normals;
        }
    }
}

// Number of levels after which no tag is semi-sharp.
int sharp_levels(const Mesh& cage) {
    float most = 0;
    for (const auto& crease : cage.tags.creases)
        if (crease.sharpness < 10) most = std::max(most, crease.sharpness);
    for (const auto& corner : cage.tags.corners)
        if (corner.sharpness < 10) most = std::max(most, corner.sharpness);
    return int(std::ceil(most));
}

// Errors at all points of level `levels` and, around every `step`-th vertex, at the points of each level down to
// 2^-`deepest`, where the last irregular pieces are approximations.
Worst against_masks(const Mesh& cage, Scheme scheme, int levels, int deepest, std::uint32_t step = 1,
                    double least_ring = 1e-8) {
    const SubdivisionSurface surface(cage, {scheme});
    const double size = diagonal(bounds(cage));
    const int sharp = sharp_levels(cage);
    Worst worst;
    oracle::Cage level = oracle::cage_of(cage, scheme), second;
    for (int i = 1; i <= std::max(levels, 2); ++i) {
        level = oracle::subdivide(level);
        if (i == 2) second = level;
    }
    const auto all = [](const oracle::Cage::Face&) { return true; };
    if (levels >= sharp) compare(surface, level, size, least_ring, all, worst);
    const auto at_vertex = [](const oracle::Cage::Face& face) {
        return std::count(face.vertex.begin(), face.vertex.end(), 0u) > 0;
    };
    std::vector<char> used(cage.positions.size(), 0);
    for (const std::uint32_t v : cage.corner_position) used[v] = 1;
    for (std::uint32_t v = 0; v < cage.positions.size(); v += step) {
        if (!used[v]) continue;
        oracle::Cage near = oracle::neighbourhood(second, v);
        for (int i = 3; i <= deepest; ++i) {
            near = oracle::neighbourhood(oracle::subdivide(near), 0);
            if (i >= std::max(sharp, 4) && (i < 6 || i > 8)) compare(surface, near, size, least_ring, at_vertex, worst);
        }
    }
    return worst;
}

void check_good(const Worst& worst, const std::string& name) {
    CHECK_MESSAGE(worst.good(), name, ": ", worst.position, " of the diagonal, ", worst.normal_deg, " degrees");
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("limit masks: one more level of subdivision changes neither limit points nor normals") {
        for (const Scheme scheme : {Scheme::catmark, Scheme::loop})
            for (const int n : {3, 4, 5, 6, 7, 9}) {
                Mesh mesh = scheme == Scheme::loop ? in_triangles(dome(n)) : dome(n);
                if (n > 4) mesh.tags.creases = {{0, 1, 10}, {0, 7, 10}};
                const oracle::Cage cage = oracle::cage_of(mesh, scheme), fine = oracle::subdivide(cage);
                const oracle::LimitMasks masks(cage), finer(fine);
                for (std::uint32_t f = 0; f < cage.faces.size(); ++f)
                    for (std::uint32_t k = 0; k < cage.faces[f].vertex.size(); ++k) {
                        const oracle::Limit limit = masks.at(f, k);
                        const std::uint32_t child = 4 * f + k;
                        REQUIRE(fine.faces[child].vertex[0] == cage.faces[f].vertex[k]);
                        const oracle::Limit after = finer.at(child, 0);
                        const bool dart = n > 4 && (cage.faces[f].vertex[k] == 1 || cage.faces[f].vertex[k] == 7);
                        CHECK(glm::distance(limit.p, after.p) < (dart ? 1e-8 : 1e-14));
                        REQUIRE(limit.normal.has_value() == after.normal.has_value());
                        if (limit.normal) CHECK(oracle::angle_deg(*limit.normal, *after.normal) < (dart ? 5e-3 : 1e-9));
                    }
            }
    }

    TEST_CASE("SubdivisionSurface: smooth vertices of any valence agree with their masks, at every depth") {
        // In triangles the valence is twice as large.
        for (const int n : {3, 5, 7, 12}) {
            check_good(against_masks(dome(n), Scheme::catmark, 3, 38, 100), "dome, valence " + std::to_string(n));
            check_good(against_masks(in_triangles(dome(n)), Scheme::loop, 3, 38, 100),
                       "triangle dome " + std::to_string(n));
        }
    }

    TEST_CASE(
        "SubdivisionSurface: at valence 8, and 10 under Loop, the normal is right down to 1e-11 of the diagonal") {
        // At higher valences the normal varies by more than the bound within the last piece of 1e-8 of the diagonal.
        check_good(against_masks(dome(8), Scheme::catmark, 3, 44, 100, 1e-11), "dome, valence 8");
        check_good(against_masks(in_triangles(dome(5)), Scheme::loop, 3, 44, 100, 1e-11), "triangle dome, valence 10");
    }

    TEST_CASE("SubdivisionSurface: creases, darts, corners and borders agree with their masks, at every depth") {
        Mesh cage = box();
        cage.tags.creases = {{4, 5, 10}, {5, 6, 10}, {6, 7, 10}, {7, 4, 10}};
        check_good(against_masks(cage, Scheme::catmark, 3, 16), "closed crease");
        check_good(against_masks(in_triangles(cage), Scheme::loop, 3, 16), "closed crease, triangles");
        cage.tags.creases.pop_back();
        check_good(against_masks(cage, Scheme::catmark, 3, 16), "two darts");
        check_good(against_masks(in_triangles(cage), Scheme::loop, 3, 16), "two darts, triangles");
        cage.tags.creases.push_back({1, 5, 10});
        cage.tags.corners = {{3, 10}};
        check_good(against_masks(cage, Scheme::catmark, 3, 16), "corners");
        check_good(against_masks(in_triangles(cage), Scheme::loop, 3, 16), "corners, triangles");
        Mesh open = dome(5);
        open.tags.boundary = SubdivisionTags::Boundary::edge_and_corner;
        open.tags.creases = {{0, 3, 10}, {0, 7, 10}, {3, 13, 10}};
        check_good(against_masks(open, Scheme::catmark, 3, 16), "border and creases");
        check_good(against_masks(in_triangles(open), Scheme::loop, 3, 16), "border and creases, triangles");
    }

    TEST_CASE("SubdivisionSurface: semi-sharp creases and corners agree with their masks after their sharp levels") {
        Mesh cage = box();
        cage.tags.creases = {{4, 5, 2.3f}, {5, 6, 1}, {6, 7, 3.5f}, {0, 1, 0.4f}};
        cage.tags.corners = {{3, 1.5f}, {6, 0.5f}};
        check_good(against_masks(cage, Scheme::catmark, 4, 16), "box");
        check_good(against_masks(in_triangles(cage), Scheme::loop, 4, 16), "box, triangles");
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("SubdivisionSurface: every real cage is within 1e-6 of the diagonal and 0.01 degrees of its "
              "masks") {
        const auto meshes = test::shared_data() / "meshes";
        const auto read = [&](const std::string& name) { return read_mesh((meshes / name).string()); };
        for (const char* name : {"catmark_torus", "catmark_nonquads", "catmark_fvar_bound1", "catmark_cubes_semisharp",
                                 "reference/catmark_dart_edgecorner_level0"}) {
            const Mesh cage = read(std::string("opensubdiv/") + name + ".obj");
            check_good(against_masks(cage, Scheme::catmark, 3, 16, 4), name);
            check_good(against_masks(in_triangles(cage), Scheme::loop, 2, 16, 8), name);
        }
        check_good(against_masks(read("spot/spot_control_mesh.obj"), Scheme::catmark, 2, 15, 11), "spot");
        check_good(against_masks(read("opensubdiv/catmark_righthanded.obj"), Scheme::catmark, 2, 14, 41),
                   "righthanded");
        check_good(against_masks(read("opensubdiv/catmark_car.obj"), Scheme::catmark, 1, 11, 101), "car");
        check_good(against_masks(read("trimesh/fuze.obj"), Scheme::loop, 1, 40, 47, 1e-11), "fuze");
    }
}
