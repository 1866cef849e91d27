// No cracks, on every closed mesh and cage that others made.
#include "bake/asset/mesh_io.h"
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

/// New boundary edges, as segments of old ones: none.
void check_no_cracks(const BaseSurface& base, const Displaced& out, const std::function<std::size_t(std::size_t)>& segments) {
    const MeshCheck before = check(base.mesh()), after = check(out.mesh);
    CHECK(after.topology.boundary_edges == segments(before.welded.boundary_edges));
    // What index topology says, coordinates say too: nothing lies twice.
    CHECK(after.welded.boundary_edges == after.topology.boundary_edges);
    CHECK(after.unused_positions == 0);
    check_sound(out.mesh);
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
        const double amplitude = 0.05 * diagonal(bounds(base.mesh()));
        DisplaceOptions options;
        options.rates.levels = base.mesh().faces() > 5000 ? 1 : 2;
        const Displaced out = displace(base, relief(noise(64), amplitude), options);
        const std::size_t rate = std::size_t(1) << options.rates.levels;
        check_no_cracks(base, out, [&](std::size_t edges) { return edges * rate; });
    }
}

} // TEST_SUITE
