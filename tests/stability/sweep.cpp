#include "stability/sweep.h"
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <sys/wait.h>

namespace stability {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

/// Text without what separates the fields of a csv.
std::string field(std::string text) {
    std::replace(text.begin(), text.end(), ',', ';');
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// Text without what separates the cells of a table.
std::string cell(std::string text) {
    std::replace(text.begin(), text.end(), '|', '/');
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// "central 1.02, sobel 0.8", or the number alone for one series.
std::string breaks(const Sweep& sweep, const std::vector<Row>& rows, bool predicted) {
    const std::vector<std::string> series = series_of(rows);
    std::string text;
    for (const std::string& name : series) {
        const bool known = std::any_of(rows.begin(), rows.end(), [&](const Row& row) {
            return row.series == name && (!predicted || row.predicted.has_value());
        });
        const std::optional<double> x = breaks_at(sweep, rows, name, predicted);
        text += (text.empty() ? "" : ", ") + (name.empty() ? "" : name + " ");
        text += !known ? "-" : x ? number(*x) : "never";
    }
    return text;
}

/// What the program does, from the first x to the last, each answer once.
std::string answers(const std::vector<Row>& rows) {
    std::vector<std::string> seen;
    std::string text;
    for (const Row& row : rows)
        if (std::find(seen.begin(), seen.end(), row.program) == seen.end()) {
            text += (text.empty() ? "" : " → ") + cell(row.program);
            seen.push_back(row.program);
        }
    return text;
}

} // namespace

std::vector<double> linear_steps(double a, double b, int steps) {
    std::vector<double> values;
    for (int i = 0; i < steps; ++i) values.push_back(a + (b - a) * i / (steps - 1));
    return values;
}

std::vector<double> geometric_steps(double a, double b, int steps) {
    std::vector<double> values;
    for (int i = 0; i < steps; ++i) values.push_back(a * std::pow(b / a, double(i) / (steps - 1)));
    return values;
}

std::vector<std::string> series_of(const std::vector<Row>& rows) {
    std::vector<std::string> series;
    for (const Row& row : rows)
        if (std::find(series.begin(), series.end(), row.series) == series.end()) series.push_back(row.series);
    return series;
}

std::optional<double> breaks_at(const Sweep& sweep, const std::vector<Row>& rows, const std::string& series,
                                bool predicted) {
    std::optional<std::array<double, 2>> before; // x and error of the row before
    for (const Row& row : rows) {
        if (row.series != series || (predicted && !row.predicted)) continue;
        const double error = predicted ? *row.predicted : row.measured;
        if (sweep.falls ? error <= sweep.limit : error > sweep.limit) {
            if (!before) return row.x;
            const auto [x, y] = *before;
            const bool log_y = sweep.log_y && y > 0 && error > 0 && sweep.limit > 0;
            const bool log_x = sweep.log_x && x > 0;
            const double part =
                log_y ? std::log(sweep.limit / y) / std::log(error / y) : (sweep.limit - y) / (error - y);
            return log_x ? x * std::pow(row.x / x, part) : x + part * (row.x - x);
        }
        before = {row.x, error};
    }
    return {};
}

std::string table_line(const Sweep& sweep, const std::vector<Row>& rows) {
    return "| [" + sweep.name + "](charts/stability/" + sweep.name + ".svg) | " + cell(sweep.construction) + " | " +
           breaks(sweep, rows, false) + " | " + breaks(sweep, rows, true) + ": " + cell(sweep.closed_form) + " | " +
           answers(rows) + " | " + sweep.test + " |\n";
}

std::string csv_lines(const Sweep& sweep, const std::vector<Row>& rows) {
    std::string text;
    for (const Row& row : rows)
        text += sweep.name + "," + field(row.series) + "," + number(row.x) + "," + number(row.measured) + "," +
                (row.predicted ? number(*row.predicted) : "") + "," + field(row.program) + "\n";
    return text;
}

std::string answer_of(const std::string& where, const std::string& arguments, const std::string& named) {
    const char* bake = std::getenv("BAKE");
    if (!bake) return "";
    const std::string command = "cd '" + where + "' && '" + bake + "' " + arguments + " 2>&1 >/dev/null";
    FILE* const pipe = popen(command.c_str(), "r");
    if (!pipe) return "";
    std::string text;
    for (char part[512]; const std::size_t read = std::fread(part, 1, sizeof part, pipe);) text.append(part, read);
    const int status = pclose(pipe);
    std::string answer = "exit " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (line.find(named) == std::string::npos) continue;
        // bake: FILE: what is wrong
        for (const char* part : {"bake: ", ": "})
            if (const auto at = line.find(part); at != std::string::npos) line.erase(0, at + std::string(part).size());
        return answer + ": " + line;
    }
    return answer;
}

Sweep sweep_named(const std::string& name) {
    for (const Theme& theme : all_themes())
        for (Sweep& sweep : theme.sweeps())
            if (sweep.name == name) return sweep;
    assert(false && "no sweep has this name");
    std::abort();
}

} // namespace stability
