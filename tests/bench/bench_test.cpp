// The rows of the benches: none without an error of what was timed.
#include "bench/bench.h"
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace {

std::filesystem::path source() {
    const char* folder = std::getenv("BAKE_SOURCE");
    REQUIRE(folder);
    return folder;
}

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) out.push_back(field);
    if (!line.empty() && line.back() == ',') out.emplace_back();
    return out;
}

bool is_finite(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0' && std::isfinite(value);
}

/// What is wrong with a row from its bench's name on; empty: nothing.
std::string fault(const std::vector<std::string>& row) {
    if (row.size() != 11) return "not 11 columns";
    for (std::size_t i = 2; i < 9; ++i)
        if (!is_finite(row[i])) return "column " + std::to_string(i) + " is no finite number";
    if (std::strtod(row[4].c_str(), nullptr) < 0 || std::strtod(row[2].c_str(), nullptr) <= 0) return "time or size";
    if (std::strtod(row[4].c_str(), nullptr) == 0 && row[10].find("not timed") == std::string::npos) return "not timed";
    const bool zero = std::strtod(row[5].c_str(), nullptr) == 0 && std::strtod(row[6].c_str(), nullptr) == 0 &&
                      std::strtod(row[7].c_str(), nullptr) == 0;
    const bool stated = row[10].find("no error: ") != std::string::npos || row[10].find("exact: ") != std::string::npos;
    if (zero && !stated) return "no error, and the note does not say why";
    return {};
}

const auto number = [] { return 1; };
const auto errors_of_number = [](const int& n) { return bench::Errors{double(n), double(n), double(n), 1}; };

// What must not compile: a work without a result, errors of something else than the result, a work without errors, a row from
// times alone or from errors that are not measured.
template <class Run, class ErrorsOf> constexpr bool is_work = std::is_constructible_v<bench::Work, Run, ErrorsOf>;
static_assert(is_work<decltype(number), decltype(errors_of_number)>);
static_assert(!std::is_constructible_v<bench::Work, decltype(number)>);
template <class Timed>
concept can_print = requires(const Timed& timed, const bench::Row& row) {
    bench::print_row(timed, row);
};
static_assert(can_print<bench::Measured> && !can_print<bench::Times> && !can_print<bench::Errors>);
static_assert(!std::is_default_constructible_v<bench::Measured>);
static_assert(!std::is_constructible_v<bench::Measured, bench::Times, bench::Errors>);
const auto nothing = [] {};
const auto errors_of_nothing = [] { return bench::Errors{}; };
const auto errors_of_text = [](const std::string&) { return bench::Errors{}; };
const auto no_errors = [](const int&) { return 1.0; };
static_assert(!is_work<decltype(nothing), decltype(errors_of_nothing)>);
static_assert(!is_work<decltype(number), decltype(errors_of_nothing)>);
static_assert(!is_work<decltype(number), decltype(errors_of_text)>);
static_assert(!is_work<decltype(number), decltype(no_errors)>);

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("bench: errors are those of the last result that was timed, given by value or by reference") {
        int runs = 0, kept = 0, limits = 0;
        const bench::Turns turns = bench::in_turn(
            3, {[&] { ++limits; }},
            {{[&] { return ++runs; }, errors_of_number}, {[&]() -> const int& { return ++kept; }, errors_of_number}});
        CHECK(limits == 4); // one round is not counted
        REQUIRE(turns.works.size() == 2);
        CHECK(turns.works[0].errors().mean == 4);
        CHECK(turns.works[1].errors().mean == 4);
        CHECK(turns.works[0].times().seconds.size() == 3);
        CHECK(turns.limits[0].seconds.size() == 3);
        CHECK(bench::once({[&] { return ++runs; }, errors_of_number}).errors().mean == 5);
    }

    TEST_CASE("bench: mean, 95th percentile and largest, and how many") {
        std::vector<float> values;
        for (int i = 1; i <= 100; ++i) values.push_back(float(i));
        const bench::Errors e = bench::errors_of(values);
        CHECK(e.mean == doctest::Approx(50.5));
        CHECK(e.p95 == 96);
        CHECK(e.max == 100);
        CHECK(e.count == 100);
        CHECK(bench::errors_of({}).count == 0);
    }

    TEST_CASE("bench: a row has eleven columns") {
        const bench::Row row{"bench", "case", 64, 2e9, 1.5, "peer", "a; b"};
        const std::string line = bench::row_text(row, 4, {0.1, 0.2, 0.3, 9}, row.note);
        const std::vector<std::string> fields = fields_of(line);
        CHECK(fault(fields).empty());
        CHECK(fields[4] == "2");
        CHECK(fields[8] == "1.5");
        // A comma in a name or a note would be one more column.
        CHECK(fault(fields_of(bench::row_text({"b", "c, d", 64, 1, 0, "e, f", ""}, 4, {1, 1, 1, 1}, "g, h"))).empty());
        CHECK(fault(fields_of("b,c,64,1,2,0,0,0,1,,note")) == "no error, and the note does not say why");
        CHECK(fault(fields_of("b,c,64,1,2,,,,1,,no error: a pass")) == "column 5 is no finite number");
        CHECK(fault(fields_of("b,c,64,1,2,nan,0,0,1,,note")) == "column 5 is no finite number");
        CHECK(fault(fields_of("b,c,64,1,2,0,0,0,1,,no error: a pass")).empty());
    }

    TEST_CASE("bench: every row of docs/charts/bench.csv has finite errors, or says why it has none") {
        std::ifstream csv(source() / "docs" / "charts" / "bench.csv");
        std::string line;
        REQUIRE(std::getline(csv, line));
        CHECK(line ==
              "date,commit,machine,bench,case,size,threads,ns_per_item,error_mean_deg,error_p95_deg,error_max_deg,"
              "ratio,against,note");
        std::size_t rows = 0;
        for (; std::getline(csv, line); ++rows) {
            const std::vector<std::string> fields = fields_of(line);
            CAPTURE(line);
            REQUIRE(fields.size() == 14);
            CHECK(fault({fields.begin() + 3, fields.end()}) == "");
        }
        CHECK(rows > 500);
    }

    TEST_CASE("bench: no bench prints a row but through print_row") {
        // Six conversions with commas between them are a row; --errors prints three.
        const std::regex row("%[^,\"]*,%[^,\"]*,%[^,\"]*,%[^,\"]*,%[^,\"]*,%");
        std::size_t files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(source() / "tests" / "bench")) {
            const std::string name = entry.path().filename().string();
            if (!name.ends_with("_bench.cpp")) continue; // sweeps have tables of their own
            std::ifstream in(entry.path());
            std::stringstream text;
            text << in.rdbuf();
            CAPTURE(name);
            CHECK_FALSE(std::regex_search(text.str(), row));
            ++files;
        }
        CHECK(files >= 15);
    }
}
