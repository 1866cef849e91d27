// No cracks, on every closed mesh and cage that others made.
#include "bake/asset/mesh_io.h"
#include "bake/base/error.h"
#include "cli/command.h"
#include "relief/displace_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

std::vector<fs::path> shared_meshes() {
    std::vector<fs::path> out;
    if (shared_data().empty()) return out;
    for (const auto& entry : fs::recursive_directory_iterator(shared_data() / "meshes"))
        if ((entry.path().extension() == ".obj" || entry.path().extension() == ".ply") && fs::file_size(entry.path()) < 3'000'000)
            out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    return out;
}

/// No crack: hangs together as before, and what index topology says, coordinates say too: nothing lies twice.
void check_no_cracks(const Topology& before, const Mesh& mesh) {
    const MeshCheck after = check(mesh);
    CHECK(after.topology.boundary_loops == before.boundary_loops);
    CHECK(after.topology.components == before.components);
    CHECK(after.topology.closed_components == before.closed_components);
    CHECK(after.topology.flipped_faces == before.flipped_faces);
    CHECK(after.welded.boundary_edges == after.topology.boundary_edges);
    CHECK(after.unused_positions == 0);
    check_sound(mesh);
}

/// A cage that check_cage() lets pass, and quads or few faces.
bool is_cage(const Mesh& mesh, const std::string& path) {
    if (mesh.faces() > 2000) return false;
    try {
        check_cage(mesh, Scheme::catmark, path);
    } catch (const Error&) {
        return false;
    }
    return true;
}

/// Segments no longer than a size that grows by 8 across the object: neighbours differ everywhere.
Rates mixed_rates(const Mesh& mesh, double faces) {
    const Bounds box = bounds(mesh);
    const Vec3d low(box.min), extent = glm::max(Vec3d(box.max - box.min), Vec3d(1e-9));
    Rates rates;
    rates.rule = Rates::Rule::edge_size;
    rates.most = 16;
    rates.size = 8 * diagonal(box) / std::sqrt(faces);
    rates.measure = [=](const Vec3d& a, const Vec3d& b) {
        const Vec3d place = ((a + b) / 2.0 - low) / extent;
        return glm::length(b - a) * (1 + 7 * std::clamp((place.x + place.y + place.z) / 3, 0.0, 1.0));
    };
    return rates;
}

} // namespace

TEST_SUITE("real") {

TEST_CASE("displace: no mesh of others gets a boundary edge that it did not have, at uniform rates") {
    const auto files = shared_meshes();
    if (files.empty()) {
        MESSAGE("no shared data: skipped");
        return;
    }
    for (const fs::path& file : files) {
        CAPTURE(file.string());
        const BaseSurface base(read_mesh(file.string()));
        DisplaceOptions options;
        options.rates.levels = base.mesh().faces() > 5000 ? 0 : base.mesh().faces() > 1000 ? 1 : 2;
        const Displaced out = displace(base, relief(noise(64), 0.05 * diagonal(bounds(base.mesh()))), options);
        const Topology before = check(base.mesh()).welded;
        check_no_cracks(before, out.mesh);
        CHECK(check(out.mesh).topology.boundary_edges == before.boundary_edges << options.rates.levels);
    }
}

TEST_CASE("displace: no mesh of others gets a crack where rates differ from edge to edge") {
    for (const fs::path& file : shared_meshes()) {
        CAPTURE(file.string());
        const BaseSurface base(read_mesh(file.string()));
        if (base.mesh().faces() > 11000) continue; // the same again, larger
        DisplaceOptions options;
        options.rates = mixed_rates(base.mesh(), 2.0 * double(base.mesh().faces()));
        const Displaced out = displace(base, relief(noise(64), 0.05 * diagonal(bounds(base.mesh()))), options);
        check_no_cracks(check(base.mesh()).welded, out.mesh);
    }
}

TEST_CASE("displace: the limit surface of every cage of others stays whole at uniform and at mixed rates") {
    int cages = 0;
    for (const fs::path& file : shared_meshes()) {
        CAPTURE(file.string());
        Mesh cage = read_mesh(file.string());
        if (!is_cage(cage, file.string())) continue;
        ++cages;
        const Topology before = check(cage).topology;
        const double amplitude = 0.05 * diagonal(bounds(cage));
        const std::size_t faces = cage.faces();
        DisplaceOptions options;
        options.rates.levels = faces > 500 ? 1 : 3;
        options.seam = Seam::blend;
        const BaseSurface base(std::move(cage), SubdivisionOptions{});
        check_no_cracks(before, displace(base, relief(noise(64), amplitude), options).mesh);
        options.rates = mixed_rates(base.mesh(), 4.0 * double(faces));
        check_no_cracks(before, displace(base, relief(noise(64), amplitude), options).mesh);
    }
    if (!shared_meshes().empty()) CHECK(cages > 5);
}

} // TEST_SUITE
