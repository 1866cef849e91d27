// No cracks, on every mesh and cage that others made: each of them once, the costly ones at coarser rates. The same at
// finer rates, with either seam: tests/bench/watertight_sweep.cpp.
#include "bake/mesh/file/mesh_io.h"
#include "cli/command.h"
#include "relief/displace/watertight.h"

using namespace bake;
using namespace bake::test;

namespace {

/// All of the collection but those that are there as .obj too.
std::vector<fs::path> shared_meshes() {
    std::vector<fs::path> out;
    for (const auto& entry : fs::recursive_directory_iterator(shared_data() / "meshes")) {
        const auto kind = entry.path().extension();
        const bool gltf = kind == ".glb" || kind == ".gltf";
        if (kind == ".obj" || kind == ".ply" || (gltf && !fs::exists(fs::path(entry.path()).replace_extension(".obj"))))
            out.push_back(entry.path());
    }
    std::sort(out.begin(), out.end());
    return out;
}

Mesh read_with_uvs(const fs::path& file) {
    Mesh mesh = read_mesh(file.string());
    give_uvs(mesh);
    return mesh;
}

void check_whole(const BaseSurface& base, const Rates& rates, Seam seam) {
    const Noisy noisy = displaced_by_noise(base, rates, seam);
    const Cracks cracks = cracks_of(noisy.displaced.mesh, noisy.plan);
    CHECK(cracks.border_edges == 0);
    CHECK(cracks.t_junctions == 0);
    CHECK(cracks.parted == 0);
    check_sound(noisy.displaced.mesh);
    if (rates.rule != Rates::Rule::uniform && base.complex().patches.size() > 1) CHECK(mixed_patches(noisy.plan) > 0);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("watertight: a corner on a point of its own, at the same place or beside it, is a crack and seen") {
        const BaseSurface base(cube());
        Noisy noisy = displaced_by_noise(base, mixed_rates(base.mesh(), 60), Seam::average);
        REQUIRE_FALSE(cracks_of(noisy.displaced.mesh, noisy.plan).any());
        Mesh& mesh = noisy.displaced.mesh;
        mesh.positions.push_back(mesh.positions[mesh.corner_position[0]]);
        mesh.corner_position[0] = std::uint32_t(mesh.positions.size() - 1);
        const Cracks parted = cracks_of(mesh, noisy.plan);
        CHECK(parted.border_edges == 4);
        CHECK(parted.t_junctions > 0);
        CHECK(parted.parted == 4);
        mesh.positions.back().x += 1e-6f;
        const Cracks open = cracks_of(mesh, noisy.plan);
        CHECK(open.border_edges == 4);
        CHECK(open.parted == 0);
    }

} // TEST_SUITE

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("displace: no mesh of others gets a boundary edge that it did not have, at uniform rates") {
        for (const fs::path& file : shared_meshes()) {
            CAPTURE(file.string());
            const BaseSurface base(read_with_uvs(file));
            const std::size_t faces = base.mesh().faces();
            const int levels = faces > 15000 ? 0 : faces > 5000 ? 1 : 2;
            check_whole(base, uniform(levels), Seam::average);
            if (faces > 5000) continue;
            // Hangs together as before, flipped faces and all.
            const Connectivity before = check(base.mesh()).welded;
            const Connectivity after =
                check(displaced_by_noise(base, uniform(levels), Seam::average).displaced.mesh).topology;
            CHECK(after.boundary_loops == before.boundary_loops);
            CHECK(after.boundary_edges == before.boundary_edges << levels);
            CHECK(after.components == before.components);
            CHECK(after.closed_components == before.closed_components);
            CHECK((after.flipped_faces > 0) == (before.flipped_faces > 0));
        }
    }

    TEST_CASE("displace: no mesh of others gets a crack where rates differ from edge to edge") {
        for (const fs::path& file : shared_meshes()) {
            CAPTURE(file.string());
            const BaseSurface base(read_with_uvs(file));
            const std::size_t faces = base.mesh().faces();
            check_whole(base,
                        mixed_rates(base.mesh(), (faces > 15000  ? 0.2
                                                  : faces > 5000 ? 1
                                                                 : 2) *
                                                     double(faces)),
                        Seam::average);
        }
    }

    TEST_CASE("displace: the limit surface of every cage of others stays whole at uniform and at mixed rates") {
        int cages = 0;
        for (const fs::path& file : shared_meshes()) {
            CAPTURE(file.string());
            Mesh cage = read_with_uvs(file);
            const std::size_t faces = cage.faces();
            const Scheme scheme = cage.corners() == 3 * faces ? Scheme::loop : Scheme::catmark;
            if (faces > 6500 || !is_cage(cage, scheme)) continue; // the sweep has those
            ++cages;
            const BaseSurface base(std::move(cage), SubdivisionOptions{.scheme = scheme});
            check_whole(base, uniform(faces > 5000 ? 0 : faces > 500 ? 1 : 3), Seam::blend);
            check_whole(base,
                        mixed_rates(base.mesh(), (faces > 5000  ? 0.5
                                                  : faces > 500 ? 1
                                                                : 4) *
                                                     double(faces)),
                        Seam::blend);
        }
        CHECK(cages > 20);
    }

} // TEST_SUITE
