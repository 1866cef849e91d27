// stability FOLDER [NAME...]: runs all sweeps, or those named, and writes FOLDER/stability.csv, a chart FOLDER/<sweep>.svg
// of each, and the lines of the tables as FOLDER/<theme>.table; scripts/stability puts them in their places.
#include "stability/sweep_chart.h"
#include "stability/themes.h"
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

using namespace stability;

int main(int argc, char** argv) {
    constexpr int steps = 33;
    if (argc < 2) return std::fprintf(stderr, "usage: stability FOLDER [NAME...]\n"), 2;
    const std::string folder = argv[1];
    std::ofstream csv(folder + "/stability.csv");
    csv << "sweep,series,x,measured,predicted,program\n";
    for (const Theme& theme : all_themes()) {
        std::ofstream table(folder + "/" + theme.name + ".table");
        for (const Sweep& sweep : theme.sweeps()) {
            if (argc > 2 && std::find(argv + 2, argv + argc, sweep.name) == argv + argc) continue;
            const auto start = std::chrono::steady_clock::now();
            const std::vector<Row> rows = sweep.rows(steps);
            csv << csv_lines(sweep, rows);
            table << table_line(sweep, rows);
            std::ofstream(folder + "/" + sweep.name + ".svg") << chart_svg(sweep, rows);
            const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            std::printf("%-28s %4zu rows %7.2f s\n", sweep.name.c_str(), rows.size(), seconds);
            std::fflush(stdout);
        }
    }
    return csv.good() ? 0 : 5;
}
