// The same bytes for any number of threads, for every verb.
#include "folders.h"
#include "stability/commands.h"
#include "stability/themes.h"

namespace stability {
namespace {

struct Work {
    const char* name;
    std::string arguments; ///< without --threads
    const char* file;      ///< what it writes; null: stdout
};

std::vector<Work> works() {
    const auto own = [](const char* name) { return "'" + (bake::test::own_meshes() / name).string() + "'"; };
    const std::string torus = own("torus.obj"), bricks = own("bricks.png"), dots = own("dots.png");
    return {
        {"check", "check " + torus + " " + bricks, nullptr},
        {"compare", "compare " + own("sky_px.png") + " " + own("sky_nx.png") + " -o a.png", "a.png"},
        {"explain", "explain " + torus + " --height " + dots + " --amplitude 2% --uv 0.3,0.4", nullptr},
        {"bump-table", "bump-table " + bricks + " -o a.exr --depth float", "a.exr"},
        {"normal-map", "normal-map " + torus + " --height " + bricks + " --amplitude 2% --size 96 -o a.png", "a.png"},
        {"surface", "surface --shape torus --resolution 32x16 -o a.ply", "a.ply"},
        {"displace", "displace " + torus + " --height " + dots + " --amplitude 2% --levels 1 -o a.ply", "a.ply"},
        {"cubemap", "cubemap labels --specular ggx --roughness 0,0.5 --size 32 -o a.exr", "a.exr"},
        {"render", "render " + torus + " --size 64 --spp 4 -o a.exr", "a.exr"},
    };
}

/// Share of bytes that differ; 1 if one of the two is missing.
double difference(const std::string& a, const std::string& b) {
    if (a.size() != b.size() || a.empty()) return 1;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
    return double(count) / double(a.size());
}

std::vector<Row> thread_rows(int steps) {
    const CommandFolder folder;
    std::vector<Row> rows;
    for (const Work& work : works()) {
        const auto made = [&](int threads) {
            const CommandFolder::Answer answer =
                folder.run(work.arguments + " --quiet --threads " + std::to_string(threads));
            return answer.code != 0 ? std::string() : work.file ? folder.bytes(work.file) : answer.out;
        };
        const std::string one = made(1);
        for (const int threads : {2, 7, 32}) {
            if (threads == 32 && steps < 20) continue;
            const double differs = difference(made(threads), one);
            rows.push_back(
                {work.name, double(threads), differs, 0.0, differs == 0 ? "the same bytes" : "bytes that differ"});
        }
    }
    return rows;
}

} // namespace

std::vector<Sweep> thread_sweeps() {
    return {
        {.name = "thread_counts",
         .construction =
             "each verb on small input with 2, 7 and 32 threads: share of bytes that differ from those of 1 thread",
         .x_label = "threads",
         .y_label = "share of bytes",
         .limit = 0,
         .closed_form = "0",
         .test = "stability/thread_test",
         .rows = thread_rows},
    };
}

} // namespace stability
