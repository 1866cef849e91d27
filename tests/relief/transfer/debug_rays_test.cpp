#include "bake/relief/transfer/debug_rays.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

Mesh half_plane() {
    Mesh mesh;
    add_patch(mesh, 1, 1, [](double s, double t) { return PatchPoint{{0.5 * s, t, 0.02}, {0, 0, 1}, {}}; });
    return mesh;
}

std::size_t faces_of(const Mesh& mesh, std::uint32_t material) {
    return std::size_t(std::count(mesh.face_material.begin(), mesh.face_material.end(), material));
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("debug_rays: the envelope's edges, needles of four triangles, and the witnesses that are misses") {
        const Job job(unit_plane(), {half_plane()}, job_options(32, 32));
        std::vector<Witness> witnesses = missed_texels(job.target, job.sources(), job.result, 5);
        REQUIRE(witnesses.size() == 5);
        witnesses.push_back(farthest_texels(job.target, job.sources(), job.result, 1).at(0)); // no miss
        const Mesh mesh = debug_rays(job.target, job.sources(), job.result, witnesses, 64);
        check_sound(polygons(mesh.positions, {}));
        REQUIRE((mesh.materials == std::vector<std::string>{"cage", "rays", "misses"}));
        REQUIRE(mesh.face_material.size() == mesh.faces());
        CHECK(faces_of(mesh, 0) == 3 * 4);      // a prism without ends on each edge, none on the diagonal
        CHECK(faces_of(mesh, 1) == 4 * 64 / 2); // of half of the map's 8 x 8 chosen texels
        CHECK(faces_of(mesh, 2) == 4 * 5);
        // Corners of the envelope lie where rays start; needles of hits end on the high-poly mesh.
        for (std::uint32_t f = 0; f < 12; ++f)
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec3f& p = mesh.positions[mesh.corner_position[mesh.face_begin[f] + k]];
                const float x = std::abs(p.x - 0.5f), y = std::abs(p.y - 0.5f);
                CHECK(p.z == doctest::Approx(job.casting.most_front()).epsilon(0.1));
                CHECK(std::max(x, y) == doctest::Approx(0.5).epsilon(0.005)); // thin, and on the border
            }
        for (std::size_t f = 12; f < mesh.faces(); ++f) {
            if (mesh.face_material[f] != 1 || f % 4 == 0) continue; // the first of a needle's four is its base
            CHECK(mesh.positions[mesh.corner_position[mesh.face_begin[f] + 2]].z ==
                  doctest::Approx(0.02).epsilon(1e-4));
        }
    }

    TEST_CASE("debug_rays: needles are closed and point outward, misses end where their rays do") {
        const Job job(unit_plane(), {half_plane()}, job_options(32, 32));
        const std::vector<Witness> witnesses = missed_texels(job.target, job.sources(), job.result, 1);
        const Mesh mesh = debug_rays(job.target, job.sources(), job.result, witnesses, 1);
        const std::size_t last = mesh.faces() - 1;
        const Vec3f tip = mesh.positions[mesh.corner_position[mesh.face_begin[last] + 2]];
        const Cast& cast = witnesses[0].cast;
        CHECK(glm::length(tip - (cast.start + (cast.reach.front + cast.reach.back) * cast.inward)) < 1e-6f);
        Vec3d middle(0); // of the twelve corners of the four triangles
        for (std::size_t c = mesh.face_begin[last - 3]; c < mesh.corners(); ++c)
            middle += Vec3d(mesh.positions[mesh.corner_position[c]]) / 12.0;
        for (std::size_t f = last - 3; f <= last; ++f) {
            const auto at = [&](std::size_t k) {
                return Vec3d(mesh.positions[mesh.corner_position[mesh.face_begin[f] + k]]) - middle;
            };
            CHECK(glm::dot(at(0), glm::cross(at(1), at(2))) > 0);
        }
    }

    TEST_CASE("debug_rays: lies where the low-poly mesh is, far from zero too") {
        Mesh low = unit_plane(), high = half_plane();
        low.origin = high.origin = {1e6, 2e6, 0};
        const Job job(low, {high}, job_options(8, 8));
        const Mesh mesh = debug_rays(job.target, job.sources(), job.result, {}, 10);
        CHECK((mesh.origin == low.origin));
        CHECK(bounds(mesh).max.x < 2);
    }

    TEST_CASE("debug_rays: the cage hides less than a tenth of what is inside, on a fine mesh too") {
        const Job job(unit_plane(0, 96), {half_plane()}, job_options(8, 8));
        const Mesh mesh = debug_rays(job.target, job.sources(), job.result, {}, 1);
        double seen = 0; // from above: half of the area of the rods' front and back
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            if (mesh.face_material[f] != 0) continue;
            const auto at = [&](std::size_t k) {
                return Vec3d(mesh.positions[mesh.corner_position[mesh.face_begin[f] + k]]);
            };
            seen += std::abs(glm::cross(at(2) - at(0), at(3) - at(1)).z) / 2 / 2;
        }
        CHECK(faces_of(mesh, 0) == 3 * 2 * 96 * 97);
        CHECK(seen > 0.01);
        CHECK(seen < 0.1);
    }

} // TEST_SUITE
