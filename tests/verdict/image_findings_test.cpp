#include "bake/verdict/inspect.h"
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

bool warns_of_levels(SampleType type, int levels) {
    ImageReport report;
    ImageCheck& c = report.check;
    c.info.type = type;
    c.kind.looks = Looks::grey;
    c.grey.levels = levels;
    c.channels.push_back({.name = "Y", .max = 1, .levels = levels});
    const std::vector<std::string> warnings = judge(report).warnings;
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& line) { return line.find("levels in use") != std::string::npos; });
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("judge: few levels are a warning in heights of 8 and of 16 bits; floats are not quantised") {
        CHECK(warns_of_levels(SampleType::u8, 99));
        CHECK(warns_of_levels(SampleType::u16, 99));
        CHECK_FALSE(warns_of_levels(SampleType::half, 99));
        CHECK_FALSE(warns_of_levels(SampleType::float32, 99));
        CHECK_FALSE(warns_of_levels(SampleType::i16, 99));
        CHECK_FALSE(warns_of_levels(SampleType::u16, 100));
        CHECK_FALSE(warns_of_levels(SampleType::u8, 16)); // a mask
    }

    TEST_CASE("judge: names of channels may have blanks and marks, but no control characters") {
        const auto warns = [](const std::string& name) {
            ImageReport report;
            report.check.info.channels = {name};
            report.check.channels.push_back({.name = name});
            const std::vector<std::string> warnings = judge(report).warnings;
            return std::count(warnings.begin(), warnings.end(),
                              "a channel has a name that cannot be printed: the file is damaged");
        };
        CHECK(warns("Layer 1.R~") == 0);
        CHECK(warns("Y\n") == 1);
        CHECK(warns("Y\x7f") == 1);
        CHECK(warns("\xc3\xa9") == 1);
    }

    TEST_CASE("judge: of a pair, the least correlation that tells the green is enough") {
        PairReport report;
        report.directx = true;
        report.check.directx = report.check.green_decided = report.check.height_decided = true;
        report.check.corr_x = report.check.corr_y = report.check.corr = pair_tells;
        CHECK_FALSE(report.unexpected());
        CHECK(judge(report).warnings == std::vector<std::string>{"the two agree only roughly (correlation 0.3)"});
        report.check.corr = std::nextafter(pair_tells, 0);
        CHECK(report.unexpected());
        REQUIRE_FALSE(judge(report).warnings.empty());
        CHECK(judge(report).warnings[0].starts_with("the two do not show the same relief"));
    }
}
