// draw_charts BENCH.csv FOLDER: the charts of docs/charts from the latest rows of the benches, one or more per verb, named after
// it. A chart whose bench has no rows is not written. Run by scripts/chart.
#include "bake/verdict/chart/line_chart.h"
#include "bake/verdict/chart/scatter.h"
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>

using namespace bake;

namespace {

struct BenchRow {
    std::string bench, what;
    double size = 0, threads = 0, ns = 0, mean = 0, p95 = 0;
};

std::vector<BenchRow> read(const char* path) {
    std::vector<BenchRow> rows;
    std::ifstream in(path);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::vector<std::string> field;
        std::istringstream fields(line);
        for (std::string one; std::getline(fields, one, ',');) field.push_back(one);
        if (field.size() < 13) continue;
        const auto number = [&](std::size_t i) { return std::strtod(field[i].c_str(), nullptr); };
        rows.push_back({field[3], field[4], number(5), number(6), number(7), number(8), number(9)});
    }
    return rows;
}

/// The last row of each case and size on the most threads, in the order of their first appearance.
std::vector<BenchRow> latest(const std::vector<BenchRow>& rows, const std::string& bench, const std::string& pattern) {
    std::vector<BenchRow> out;
    const std::regex cases(pattern);
    for (const BenchRow& row : rows) {
        if (row.bench != bench || !std::regex_search(row.what, cases)) continue;
        const auto known = std::find_if(out.begin(), out.end(),
                                        [&](const BenchRow& o) { return o.what == row.what && o.size == row.size; });
        if (known == out.end()) out.push_back(row);
        else if (row.threads >= known->threads) *known = row;
    }
    return out;
}

void write(const std::string& path, const std::string& svg) {
    std::ofstream out(path, std::ios::binary);
    out << svg;
    if (!out.flush()) std::fprintf(stderr, "draw_charts: %s cannot be written\n", path.c_str()), std::exit(5);
    std::printf("%s\n", path.c_str());
}

/// One chart of rows; label and cost are functions of a row. Bars go from the mean to the 95th percentile.
struct BenchChart {
    std::string name, title, x_label, y_label, bench, pattern;
    double size = 0; ///< of the rows; 0: any
    std::function<std::string(const BenchRow&)> label;
    std::function<double(const BenchRow&)> cost = [](const BenchRow& row) { return row.ns; };
    std::string dot = "mean";
};

void draw(const std::vector<BenchRow>& rows, const std::string& folder, const BenchChart& of) {
    ScatterChart chart;
    chart.title = of.title;
    chart.x_label = of.x_label;
    chart.y_label = of.y_label;
    chart.note = "Dot: " + of.dot + " error. Bar: to the 95th percentile, where that is larger.";
    for (const BenchRow& row : latest(rows, of.bench, of.pattern)) {
        if (of.size > 0 && row.size != of.size) continue;
        chart.dots.push_back({of.label(row), of.cost(row), row.mean});
        if (row.p95 > row.mean) chart.dots.back().error_low = row.mean, chart.dots.back().error_high = row.p95;
    }
    if (!chart.dots.empty()) write(folder + "/" + of.name + ".svg", scatter_svg(chart));
}

/// Replaces each match of the pattern; then "_" by a space.
std::string renamed(const std::string& text, const char* pattern, const char* by) {
    std::string out = std::regex_replace(text, std::regex(pattern), by);
    std::replace(out.begin(), out.end(), '_', ' ');
    return out;
}
auto rename(const char* pattern, const char* by) {
    return [=](const BenchRow& row) { return renamed(row.what, pattern, by); };
}

void draw_tracer(const std::vector<BenchRow>& rows, const std::string& folder) {
    LineChart chart;
    chart.title = "Preview tracer and bare loops over Embree, 1024 x 1024";
    chart.x_label = "triangles";
    chart.y_label = "million rays per second";
    chart.logarithmic_x = chart.logarithmic_y = true;
    for (const char* name : {"rtcIntersect16", "rtcIntersect1", "phong", "bump_table_mirror"}) {
        LineSeries series{renamed(name, "^$", ""), {}};
        for (const BenchRow& row : latest(rows, "tracer", "^" + std::string(name) + "$"))
            series.points.push_back({row.size, 1e3 / row.ns});
        std::sort(series.points.begin(), series.points.end(),
                  [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
        if (!series.points.empty()) chart.series.push_back(series);
    }
    if (!chart.series.empty()) write(folder + "/tracer.svg", line_chart_svg(chart));
}

double milliseconds(const BenchRow& row) { return 1e-6 * row.ns * row.size; }

const char* const degrees = "error of the normal, deg";

void draw_maps(const std::vector<BenchRow>& rows, const std::string& folder) {
    const auto filters = [&](const char* name, const char* title, const char* bits) {
        draw(rows, folder,
             {name, title, "ns per texel", degrees, "bump_table", std::string(bits) + "$", 4096,
              [&](const BenchRow& row) { return renamed(row.what, (std::string(bits) + "$").c_str(), ""); }});
    };
    filters("bump-table", "Derivative filters on 16-bit waves, 4096 x 4096 in memory", "_16bit");
    filters("bump-table-8bit", "Derivative filters on 8-bit waves, 4096 x 4096 in memory", "_8bit");
    draw(rows, folder,
         {"bump-table-files", "Bump table, 4096 x 4096, file to file", "ns per texel", degrees, "bump_table_file", ".",
          4096, rename("^$", "")});
    draw(rows, folder,
         {"normal-map", "Normal map of a relief on a torus of 262144 triangles, 4096 x 4096", "ns per texel", degrees,
          "normal_map", "^torus_262k_", 0, rename("^torus_262k_", "")});
    draw(rows, folder,
         {"normal-map-files", "Normal map, 1024 x 1024, torus of 4096 triangles, file to file", "ns per texel", degrees,
          "normal_map_file", ".", 1024, rename("^torus_4k_", "bake ")});
}

void draw_surfaces(const std::vector<BenchRow>& rows, const std::string& folder) {
    draw(rows, folder,
         {"surface", "Limit of the cage Spot with first derivatives, one thread", "ns per point", degrees,
          "subdivision", "^spot_P_Du_Dv_", 0, rename("^spot_P_Du_Dv_(points|lattice)?", "$1")});
    draw(rows, folder,
         {"displace", "A displaced torus: normal at the middle of a face", "ms in all", degrees, "displace",
          "^torus_levels_[0-9]+(_blend)?$", 0, rename("^torus_levels_([0-9]+)", "--levels $1"), milliseconds});
    draw(rows, folder,
         {"check", "Distance of a sheet of 65536 triangles from a plane", "ms in all", "relative error of mean and rms",
          "mesh_distance", ".", 0, rename("^samples_", "--samples "), milliseconds});
}

void draw_pictures(const std::vector<BenchRow>& rows, const std::string& folder) {
    const char* const over_mean = "error of radiance over its mean";
    draw(rows, folder,
         {"cubemap", "A lat-long of 2048 to six faces of 512: a smooth sky", "ns per texel", over_mean, "cubemap", ".",
          512, [](const BenchRow& row) { return "--samples " + (row.what == "one" ? "1" : row.what); }});
    draw(rows, folder,
         {"cubemap-irradiance", "Irradiance of a sun and a smooth sky, faces of 512, one thread",
          "ns per texel of the sky", over_mean, "prefilter", "^irradiance_.*_sun_and_sky$", 512,
          rename("^irradiance_(.*)_sun_and_sky$", "$1")});
    draw(rows, folder,
         {"render", "Light of the sky lebombo, by how directions are drawn", "ms per 1000 pixels", over_mean,
          "sky_light", "^lebombo_1k_", 0,
          [](const BenchRow& row) {
              return renamed(row.what, "^lebombo_1k_", "") + ", " + std::to_string(int(row.size)) + " spp";
          },
          [](const BenchRow& row) { return 1e-3 * row.ns * row.size; }, "rms"});
    draw(rows, folder,
         {"compare", "Metrics on two pictures of 512 x 512", "ns per pixel",
          "difference from the papers' formulas in double", "metric", ".", 512, rename("^$", "")});
    draw_tracer(rows, folder);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 3) return std::fprintf(stderr, "usage: draw_charts BENCH.csv FOLDER\n"), 2;
    const std::vector<BenchRow> rows = read(argv[1]);
    if (rows.empty()) return std::fprintf(stderr, "draw_charts: %s has no rows\n", argv[1]), 3;
    draw_maps(rows, argv[2]);
    draw_surfaces(rows, argv[2]);
    draw_pictures(rows, argv[2]);
    return 0;
}
