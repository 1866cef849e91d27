// The automatic envelope as a cage: what it encloses, and that a bake from it is the same.
#include "bake/relief/transfer/cage.h"
#include "relief/transfer/relief_torus.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

/// Per position, how far out the cage is.
std::vector<double> distances(const Mesh& low, const Mesh& cage) {
    std::vector<double> out;
    for (std::size_t i = 0; i < low.positions.size(); ++i)
        out.push_back(glm::length(Vec3d(cage.positions[i]) - Vec3d(low.positions[i])));
    return out;
}

/// The largest change along a side of a face.
double steepest(const Mesh& mesh, const std::vector<double>& distance) {
    double worst = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t c = mesh.face_begin[f] + 1; c < mesh.face_begin[f + 1]; ++c)
            worst =
                std::max(worst, std::abs(distance[mesh.corner_position[c]] - distance[mesh.corner_position[c - 1]]));
    return worst;
}

struct Again {
    explicit Again(const Job& job)
        : cage(envelope_cage(job.target.surface, job.sources())), casting(job.target.surface, cage, "cage") {
        TransferOptions options = job.options.transfer;
        options.try_wider = false;
        result = transfer(job.target, job.high, casting, options, "low");
    }
    /// Angles between the normals of the two bakes.
    oracle::Spread difference(const Job& job) const {
        std::vector<double> angles;
        for (int y = 0; y < result.map.height(); ++y)
            for (int x = 0; x < result.map.width(); ++x) {
                const float* rgb = &result.map.at(x, y);
                angles.push_back(oracle::angle_deg(2.0 * Vec3d(rgb[0], rgb[1], rgb[2]) - 1.0, job.normal(x, y)));
            }
        return oracle::spread(angles);
    }
    Mesh cage;
    Casting casting;
    Transfer result;
};

/// A sphere with a hill on one side.
Mesh hilly_sphere() {
    Mesh mesh = lat_long_sphere(192, 96, 1);
    for (Vec3f& p : mesh.positions) p *= 1 + 0.1f * std::exp(-20 * glm::dot(p - Vec3f(1, 0, 0), p - Vec3f(1, 0, 0)));
    return mesh;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("cage: is as far out as the envelope and half of the reach inward, and smooth") {
        const Job job(lat_long_sphere(48, 24, 0.99), {hilly_sphere()}, job_options(96, 48));
        const Mesh cage = envelope_cage(job.target.surface, job.sources());
        CHECK((cage.face_begin == job.low.face_begin));
        CHECK((cage.corner_position == job.low.corner_position));
        const std::vector<Reach> reach = measured_reach(job.target.surface, job.high);
        std::vector<double> needed;
        for (const Reach& r : reach) needed.push_back(std::max(double(r.front), 0.5 * double(r.back)));
        const std::vector<double> distance = distances(job.low, cage);
        for (std::size_t i = 0; i < needed.size(); ++i) CHECK(distance[i] >= needed[i] - 1e-5);
        CHECK(steepest(job.low, distance) < 0.7 * steepest(job.low, needed));
        // Far from the hill little is raised.
        for (std::size_t i = 0; i < needed.size(); ++i)
            if (job.low.positions[i].x < -0.5f) CHECK(distance[i] < 1.2 * needed[i]);
    }

    TEST_CASE("cage: corners that meet stay together, and faces that OpenMesh refuses keep their distance") {
        // A square three of whose copies share a side, and one that lies on another.
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0, 1}, {1, 1, 1}};
        for (const std::uint32_t c : {0, 1, 2, 3, 1, 4, 5, 2, 1, 6, 7, 2, 0, 1, 2, 3})
            mesh.corner_position.push_back(c);
        mesh.face_begin = {0, 4, 8, 12, 16};
        const MeshSurface surface = make_mesh_surface(mesh, {.derivatives = false});
        const HighSurface high(named({unit_plane(0.05, 4)}), mesh.origin, HighNormals::smooth, 1);
        const Casting casting(surface, CastBy::blend, constant_reach(surface, {0.1f, 0.3f, 0}));
        const Mesh cage = envelope_cage(surface, {{{&high, &casting}}, {}});
        for (const double distance : distances(mesh, cage)) {
            CHECK(distance > 0.149);
            CHECK(distance < 0.15 / 0.34);
        }
        CHECK_NOTHROW(Casting(surface, cage, "cage"));
    }

    TEST_CASE("cage: a part without a source is pushed out along its normals, as far as the farthest") {
        Mesh low = unit_plane();
        add_patch(low, 1, 1, [](double x, double y) { return PatchPoint{{x, y, 5}, {0, 0, 1}, {x, y}}; });
        const MeshSurface surface = make_mesh_surface(low, {.derivatives = false});
        const HighSurface high(named({unit_plane(0.05)}), low.origin, HighNormals::smooth, 1);
        const Casting casting(surface, CastBy::blend, constant_reach(surface, {0.1f, 0.1f, 0}));
        const Mesh cage = envelope_cage(surface, {{{&high, &casting}}, {0, no_index}});
        for (std::size_t i = 0; i < low.positions.size(); ++i)
            CHECK(glm::length(cage.positions[i] - low.positions[i] - Vec3f(0, 0, 0.1f)) < 1e-6f);
    }

} // TEST_SUITE

TEST_SUITE("oracle") {

    TEST_CASE("cage: a bake from it is that from the envelope") {
        const oracle::TorusRelief relief{};
        const Job torus(oracle::LowTorus(24, 12).mesh(), {oracle::relief_mesh(relief, 256, 128)}, job_options(128, 64));
        REQUIRE(torus.report().missed == 0);
        const Again again(torus);
        CHECK(again.result.report.missed == 0);
        const oracle::Spread smooth = again.difference(torus);
        CHECK(smooth.mean < 0.03);
        CHECK(smooth.max < 0.3);
        // Over hard edges a cage has averaged directions.
        JobOptions options = job_options(192, 128);
        options.cast = CastBy::averaged;
        const Job box(sharp_box(), {rounded_box(80, 0.08, true)}, options);
        const Again box_again(box);
        CHECK(box_again.result.report.missed == 0);
        const oracle::Spread hard = box_again.difference(box);
        CHECK(hard.max < 1e-3);
    }

} // TEST_SUITE
