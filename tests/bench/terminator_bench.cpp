// RMSE against true displacement of the rules for tilted shading normals, over slope and height of the sun.
//   terminator_bench                prints case,slope,height_deg,truth,off,flip,rotate,estevez,chiang,best
//   terminator_bench --draw CSV     prints a chart of that table (SVG): the best rule in each region
#include "stability/terminator_map.h"
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

using namespace bake::test;

namespace {

constexpr std::array<const char*, 5> colours = {"#d9d9d9", "#a6cee3", "#6baed6", "#fdae6b", "#a1d99b"};
constexpr int cell_width = 46, cell_height = 22, panel_width = 6 * cell_width + 70, panel_height = 7 * cell_height + 70;

int measure() {
    std::printf("case,slope,height_deg,truth,off,flip,rotate,estevez,chiang,best\n");
    for (const std::string& name : TerminatorMapOptions{}.cases) {
        TerminatorMapOptions one;
        one.cases = {name};
        for (const TerminatorRow& row : terminator_map(one)) {
            std::printf("%s,%g,%g,%.4g", name.c_str(), row.slope, row.height_deg, row.truth);
            for (const double rmse : row.rmse) std::printf(",%.4g", rmse);
            std::printf(",%s\n", terminator_names[std::size_t(row.best())]);
        }
        std::fflush(stdout);
    }
    return 0;
}

std::vector<TerminatorRow> read_rows(const char* path) {
    std::vector<TerminatorRow> rows;
    std::ifstream in(path);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream fields(line);
        TerminatorRow row;
        std::string field;
        std::getline(fields, row.name, ',');
        const auto next = [&] { return std::getline(fields, field, ',') ? std::stod(field) : 0.0; };
        row.slope = next(), row.height_deg = next(), row.truth = next();
        for (double& rmse : row.rmse) rmse = next();
        rows.push_back(row);
    }
    return rows;
}

void print_text(int x, int y, const char* anchor, const std::string& text) {
    std::printf("<text x='%d' y='%d' text-anchor='%s'>%s</text>\n", x, y, anchor, text.c_str());
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

/// One case: a cell for each slope and height, with the colour of the best rule and its error over that of `off`.
void draw_case(const std::vector<TerminatorRow>& rows, const TerminatorMapOptions& o, const std::string& name, int x,
               int y) {
    const bool mirror = name.ends_with("mirror");
    print_text(x + 3 * cell_width, y - 8, "middle", name);
    print_text(x + 3 * cell_width, y + 7 * cell_height + 32, "middle", "steepest slope");
    std::printf("<text transform='translate(%d,%d) rotate(-90)' text-anchor='middle'>%s (deg)</text>\n", x - 26,
                y + 7 * cell_height / 2, mirror ? "height of the viewer" : "height of the sun");
    for (std::size_t i = 0; i < o.slopes.size(); ++i)
        print_text(x + int(i) * cell_width + cell_width / 2, y + 7 * cell_height + 15, "middle", number(o.slopes[i]));
    for (std::size_t j = 0; j < o.heights_deg.size(); ++j)
        print_text(x - 5, y + (6 - int(j)) * cell_height + 15, "end", number(o.heights_deg[j]));
    for (const TerminatorRow& row : rows) {
        if (row.name != name) continue;
        for (std::size_t i = 0; i < o.slopes.size(); ++i)
            for (std::size_t j = 0; j < o.heights_deg.size(); ++j) {
                if (o.slopes[i] != row.slope || o.heights_deg[j] != row.height_deg) continue;
                const int left = x + int(i) * cell_width, top = y + (6 - int(j)) * cell_height, best = row.best();
                std::printf("<rect x='%d' y='%d' width='%d' height='%d' fill='%s' stroke='#ffffff'/>\n", left, top,
                            cell_width, cell_height, colours[std::size_t(best)]);
                char ratio[16];
                std::snprintf(ratio, sizeof ratio, "%.2f", row.rmse[std::size_t(best)] / row.rmse[0]);
                if (best != 0) print_text(left + cell_width / 2, top + 15, "middle", ratio);
            }
    }
}

int draw(const char* path) {
    const std::vector<TerminatorRow> rows = read_rows(path);
    const TerminatorMapOptions options;
    const int width = 3 * panel_width + 20, height = 3 * panel_height + 60;
    std::printf("<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' viewBox='0 0 %d %d' "
                "font-family='sans-serif' font-size='11'>\n<rect width='%d' height='%d' fill='#ffffff'/>\n",
                width, height, width, height, width, height);
    print_text(width / 2, 18, "middle",
               "Least RMSE against true displacement: colour = terminator rule, number = its error over that of off");
    for (std::size_t i = 0; i < options.cases.size(); ++i)
        draw_case(rows, options, options.cases[i], 60 + int(i % 3) * panel_width, 58 + int(i / 3) * panel_height);
    for (std::size_t i = 0; i < terminator_names.size(); ++i) {
        const int x = 60 + panel_width + 20, y = 70 + 2 * panel_height + int(i) * 24;
        std::printf("<rect x='%d' y='%d' width='30' height='16' fill='%s'/>\n", x, y, colours[i]);
        print_text(x + 40, y + 12, "start",
                   std::string(terminator_names[i]) + (i == 0 ? ": no other is 1 % better" : ""));
    }
    std::printf("</svg>\n");
    return rows.empty() ? 3 : 0;
}

} // namespace

int main(int argc, char** argv) { return argc == 3 && std::strcmp(argv[1], "--draw") == 0 ? draw(argv[2]) : measure(); }
