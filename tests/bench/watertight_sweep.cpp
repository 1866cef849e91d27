// Every mesh and cage of a folder displaced under a noise of 5 % of its diagonal, at uniform and at mixed rates, and
// looked over for cracks. A plain table; exits with 1 where there is one.
//
//   watertight_sweep ../shared/data/meshes
//
// surface: linear (the mesh itself), catmark or loop (the limit, where check_cage() lets the mesh pass). border: edges of
// one face beyond those that the base's own border becomes. T: points of the border likewise. parted: edges of the border
// that are none once bit-equal points are one. mixed: patches whose sides are cut differently. Meshes without uvs get
// them from above.
#define DOCTEST_CONFIG_DISABLE // of the tests' helpers only those without checks are used
#include "bake/mesh/file/mesh_io.h"
#include "bench.h"
#include "relief/displace/watertight.h"
#include <filesystem>

using namespace bake;
namespace fs = std::filesystem;

namespace {

/// Rows of one surface; whether it was whole in all.
bool sweep(const std::string& name, const char* kind, const BaseSurface& base) {
    bool whole = true;
    const std::size_t patches = base.complex().patches.size();
    for (const bool mixed : {false, true})
        for (const Seam seam : {Seam::average, Seam::blend}) {
            const Rates rates = mixed ? test::mixed_rates(base.mesh(), 4.0 * double(patches))
                                      : test::uniform(patches > 20000  ? 1
                                                      : patches > 2000 ? 2
                                                                       : 3);
            std::optional<test::Noisy> noisy;
            const double seconds = bench::seconds([&] { noisy.emplace(test::displaced_by_noise(base, rates, seam)); });
            const Mesh& mesh = noisy->displaced.mesh;
            const test::Cracks cracks = test::cracks_of(mesh, noisy->plan);
            std::printf("%-34s %6zu %-8s %-8s %-8s %8zu %7zu %7lld %5lld %7lld %8.2f\n", name.c_str(),
                        base.mesh().faces(), kind, mixed ? "mixed" : "uniform",
                        seam == Seam::blend ? "blend" : "average", mesh.faces(), test::mixed_patches(noisy->plan),
                        cracks.border_edges, cracks.t_junctions, cracks.parted, seconds);
            std::fflush(stdout);
            whole &= !cracks.any();
        }
    return whole;
}

} // namespace

int main(int argc, char** argv) {
    std::vector<fs::path> files;
    if (argc == 2 && fs::is_directory(argv[1]))
        for (const auto& entry : fs::recursive_directory_iterator(argv[1]))
            if (const auto kind = entry.path().extension();
                kind == ".obj" || kind == ".ply" || kind == ".glb" || kind == ".gltf")
                files.push_back(entry.path());
    if (files.empty()) {
        std::fprintf(stderr, "watertight_sweep FOLDER: a folder with meshes (.obj .ply .glb .gltf)\n");
        return 2;
    }
    std::sort(files.begin(), files.end());
    std::printf("%-34s %6s %-8s %-8s %-8s %8s %7s %7s %5s %7s %8s\n", "mesh", "faces", "surface", "rates", "seam",
                "result", "mixed", "border", "T", "parted", "seconds");
    bool whole = true;
    for (const fs::path& file : files) {
        Mesh mesh = read_mesh(file.string());
        test::give_uvs(mesh);
        const std::string name = file.filename().string();
        whole &= sweep(name, "linear", BaseSurface(Mesh(mesh)));
        for (const Scheme scheme : {Scheme::catmark, Scheme::loop})
            if (test::is_cage(mesh, scheme))
                whole &= sweep(name, scheme == Scheme::catmark ? "catmark" : "loop",
                               BaseSurface(Mesh(mesh), SubdivisionOptions{.scheme = scheme}));
    }
    std::printf("%s\n", whole ? "no cracks" : "CRACKS");
    return whole ? 0 : 1;
}
