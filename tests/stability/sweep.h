// Sweeps across the points where methods break: a quantity x grows, and every step has the measured error, that of the
// closed form, and what the program does there. A sweep is a row of docs/failures.md, a chart of docs/charts/stability,
// and a test, which calls the same function with few steps.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stability {

struct Row {
    std::string series; ///< the curve: a method, a filter, a shape; empty if there is one
    double x = 0;
    double measured = 0;
    std::optional<double> predicted; ///< by the closed form; nothing where there is none
    std::string program;             ///< what the program does at x: its rule, note or exit code, a few words
};

struct Sweep {
    std::string name;         ///< snake_case: the name of the chart, unique
    std::string construction; ///< what is swept on what
    std::string x_label, y_label;
    bool log_x = false, log_y = false;
    double limit = 0;        ///< broken: measured above this value, or below it if `falls`
    bool falls = false;      ///< the measured quantity is a margin, not an error
    std::string closed_form; ///< the formula of `predicted`, and of the break
    std::string test;        ///< the test that holds it: file and name
    std::function<std::vector<Row>(int steps)> rows;
};

/// `steps` values from a to b, both included, evenly or by equal factors.
std::vector<double> linear_steps(double a, double b, int steps);
std::vector<double> geometric_steps(double a, double b, int steps);

/// The first x at which a series breaks, interpolated between its rows; nothing if it never does.
std::optional<double> breaks_at(const Sweep& sweep, const std::vector<Row>& rows, const std::string& series,
                                bool predicted);
/// Names of the series in the order of their first rows.
std::vector<std::string> series_of(const std::vector<Row>& rows);

/// Line of the table of docs/failures.md: name with a link to the chart, construction, break as measured and by the closed
/// form per series, what the program does from the first x to the last, test.
std::string table_line(const Sweep& sweep, const std::vector<Row>& rows);
/// Lines "sweep,series,x,measured,predicted,program".
std::string csv_lines(const Sweep& sweep, const std::vector<Row>& rows);

/// "exit 4: has no uvs; unwrap the mesh first": what the command $BAKE answers to these arguments, which a shell reads, run
/// in the folder `where`; the first note that has `named` in it if that is given. Paths are left out.
std::string answer_of(const std::string& where, const std::string& arguments, const std::string& named = "");

/// The themes, in the order of the tables. Each is the section <!-- sweeps NAME --> of docs/failures.md.
struct Theme {
    std::string name;
    std::vector<Sweep> (*sweeps)();
};
std::vector<Theme> all_themes();
/// The sweep of that name; asserts that there is one.
Sweep sweep_named(const std::string& name);

} // namespace stability
