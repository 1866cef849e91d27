#include "bake/base/parse_double.h"
#include <clocale>
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// While it lives, the C library writes and reads a decimal comma, where the machine has such a locale.
struct CommaLocale {
    CommaLocale() {
        for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"})
            if (std::setlocale(LC_NUMERIC, name)) return;
    }
    ~CommaLocale() { std::setlocale(LC_NUMERIC, "C"); }
};

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("parse_finite: decimal numbers, whole words, finite ones alone") {
        const CommaLocale comma;
        CHECK(parse_finite("0.5") == 0.5);
        CHECK(parse_finite("-1.5e3") == -1500);
        CHECK(parse_finite("+2") == 2);
        CHECK(parse_finite(".5") == 0.5);
        CHECK(parse_finite("5.") == 5);
        CHECK(parse_finite("1e-400") == 0);
        CHECK(parse_finite("-1e-400") == 0);
        CHECK(parse_finite("4.9e-324") == 4.9e-324);
        for (const char* bad : {"",
                                " ",
                                " 1",
                                "1 ",
                                "nan",
                                "NaN",
                                "-nan",
                                "nan(1)",
                                "inf",
                                "-inf",
                                "infinity",
                                "1e999",
                                "-1e999",
                                "0x10",
                                "0x1p3",
                                "1,5",
                                "1.5.5",
                                "1e",
                                "--1",
                                "+-1",
                                "e5",
                                ".",
                                "1\n",
                                "1\n2",
                                "1_000",
                                "\xc2\xa0"
                                "1",
                                "٣"})
            CHECK_MESSAGE(!parse_finite(bad), std::string(bad));
        CHECK(!parse_finite(std::string_view("1\0", 2)));
    }

    TEST_CASE("parse_double: what double cannot hold is infinite or 0, in any locale") {
        const CommaLocale comma;
        const auto value = [](const char* text) {
            double v = 7;
            CHECK(parse_double(text, v));
            CHECK(*text == '\n');
            return v;
        };
        CHECK(value("1.5e999\n") == HUGE_VAL);
        CHECK(value("-1.5e999\n") == -HUGE_VAL);
        CHECK(value("0.000001e400\n") == HUGE_VAL);
        CHECK(value("1.5e-999\n") == 0);
        CHECK(std::signbit(value("-1.5e-999\n")));
    }

} // TEST_SUITE
