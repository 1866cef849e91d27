#include "bake/verdict/report_text.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("report_text: names are padded, and control characters of both columns escaped") {
        CHECK(row("size", "3 x 4") == "  size           3 x 4\n");
        CHECK(row("a\n", "\x1b[2J") == "  a\\n            \\x1b[2J\n");
    }

    TEST_CASE("report_text: notes, then warnings; nothing wrong only where nothing is") {
        CHECK(endings({}) == "  nothing wrong\n");
        CHECK(finding_rows({}) == "");
        const Findings both{.warnings = {"hot"}, .notes = {"wide"}};
        CHECK(finding_rows(both) == "  note           wide\n  warning: hot\n");
        CHECK(endings(both) == finding_rows(both));
        CHECK(endings({.notes = {"wide"}}) == "  note           wide\n  nothing wrong\n");
    }
}
