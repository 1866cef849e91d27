#include "bake/base/text_line.h"
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

/// parse_float of the whole text, or NaN with a message.
float parsed(const std::string& text) {
    const std::string line = text + "\n";
    const char* p = line.data();
    float value = std::numeric_limits<float>::quiet_NaN();
    const bool read = bake::parse_float(p, value);
    CHECK_MESSAGE(read, text);
    CHECK_MESSAGE(p == line.data() + text.size(), text);
    return value;
}

bool refused(const std::string& text) {
    const std::string line = text + "\n";
    const char* p = line.data();
    float value = 0;
    return !bake::parse_float(p, value) && p == line.data();
}

/// The C library's correctly rounded float of the same text, infinite or 0 where the text is beyond floats.
void check_nearest(const std::string& text) {
    const float expected = std::strtof(text.c_str(), nullptr);
    const float value = parsed(text);
    CHECK_MESSAGE(std::memcmp(&value, &expected, sizeof value) == 0, text);
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("parse_float: reads every decimal form and stops behind it") {
        CHECK(parsed("0") == 0);
        CHECK(std::signbit(parsed("-0")));
        CHECK(parsed("+1.5") == 1.5f);
        CHECK(parsed(".5") == 0.5f);
        CHECK(parsed("5.") == 5);
        CHECK(parsed("-1e3") == -1000);
        CHECK(parsed("1E+2") == 100);
        CHECK(parsed("12345678901234567890123") == 12345678901234567890123.0f);
        CHECK(parsed("0.00000000000000000000000000001") == 1e-29f);
    }

    TEST_CASE("parse_float: too large is infinite, too small is 0, with the sign kept") {
        CHECK(parsed("1e39") == std::numeric_limits<float>::infinity());
        CHECK(parsed("-1e999") == -std::numeric_limits<float>::infinity());
        CHECK(parsed("1" + std::string(400, '0')) == std::numeric_limits<float>::infinity());
        CHECK(parsed("3.4028236e38") == std::numeric_limits<float>::infinity());
        CHECK(parsed("3.4028235e38") == std::numeric_limits<float>::max());
        CHECK(parsed("1e-46") == 0);
        CHECK(parsed("1e-999") == 0);
        CHECK(parsed("0." + std::string(400, '0') + "1") == 0);
        CHECK(parsed("0." + std::string(400, '0') + "1e401") == 1);
        CHECK(std::signbit(parsed("-1e-999")));
        CHECK(parsed("1e99999999999999999999") == std::numeric_limits<float>::infinity());
        CHECK(parsed("1e-99999999999999999999") == 0);
        CHECK(parsed("123." + std::string(500, '4') + "e37") == std::numeric_limits<float>::infinity());
        CHECK(parsed("0." + std::string(80, '0') + "9e33") == 0);
        CHECK(parsed("1e-45") == std::numeric_limits<float>::denorm_min());
        CHECK(std::isnan(parsed("nan")));
        CHECK(std::isinf(parsed("-inf")));
    }

    TEST_CASE("parse_float: stops at what no number goes on with, hexadecimal digits and a bare e included") {
        const struct {
            const char* text;
            float value;
            int length;
        } cases[] = {{"0x10", 0, 1}, {"1e", 1, 1}, {"1e+", 1, 1}, {"1.5.5", 1.5f, 3}, {"2/3", 2, 1}};
        for (const auto& [text, value, length] : cases) {
            const std::string line = std::string(text) + "\n";
            const char* p = line.data();
            float read = -1;
            CHECK(bake::parse_float(p, read));
            CHECK(read == value);
            CHECK(p == line.data() + length);
        }
    }

    TEST_CASE("parse_float: words, lone signs and points are no numbers") {
        for (const char* text : {"", "-", "+", ".", "e5", "-.", "--1", "+-1", "-+1", "++1", "x", "/1", "#", " 1"})
            CHECK_MESSAGE(refused(text), text);
    }

    TEST_CASE("parse_integer: reads signs, and beyond 18 digits stays at the limit instead of wrapping") {
        const auto integer = [](const std::string& text) {
            const std::string line = text + "\n";
            const char* p = line.data();
            std::int64_t value = -7;
            return bake::parse_integer(p, value) ? value : std::int64_t(-7);
        };
        CHECK(integer("42") == 42);
        CHECK(integer("-42") == -42);
        CHECK(integer("+42") == 42);
        CHECK(integer("000000000000000000000000042") == 42);
        CHECK(integer("18446744073709551617") == 1000000000000000000); // 2^64 + 1 must not become 1
        CHECK(integer("x") == -7);
    }

    TEST_CASE("next_line: lines end at '\\n', join after a backslash, and a comment's backslash joins nothing") {
        const std::string text = "a b\n\nc \\\nd\\\r\ne\n# f \\\ng\r\nlast \\\n";
        std::vector<std::string> lines;
        std::vector<std::ptrdiff_t> starts;
        for (bake::LineCursor cursor{.next = text.data(), .stop = text.data() + text.size()}; next_line(cursor);) {
            CHECK(*cursor.end == '\n');
            lines.emplace_back(cursor.begin, cursor.end);
            starts.push_back(cursor.at - text.data());
        }
        CHECK(lines == std::vector<std::string>{"a b", "", "c  d e", "# f \\", "g\r", "last "});
        CHECK(starts == std::vector<std::ptrdiff_t>{0, 4, 5, 15, 21, 24});
    }

    TEST_CASE("split_lines: the pieces' lines are the text's lines, whatever the size of the pieces") {
        std::mt19937 random(3);
        std::string text;
        for (int i = 0; i < 400; ++i) text += std::string(random() % 9, 'x') + (random() % 4 ? "\n" : "\\\n");
        text += "end\n";
        const auto lines_of = [](const char* begin, const char* end) {
            std::vector<std::string> lines;
            for (bake::LineCursor cursor{.next = begin, .stop = end}; next_line(cursor);)
                lines.emplace_back(cursor.begin, cursor.end);
            return lines;
        };
        const auto whole = lines_of(text.data(), text.data() + text.size());
        for (const std::size_t grain : {1, 2, 7, 64, 1000, 100000}) {
            const auto bounds = bake::split_lines(text.data(), text.data() + text.size(), grain);
            CHECK(bounds.size() == (text.size() + grain - 1) / grain + 1);
            std::vector<std::string> pieces;
            for (std::size_t i = 0; i + 1 < bounds.size(); ++i)
                for (const std::string& line : lines_of(bounds[i], bounds[i + 1])) pieces.push_back(line);
            CHECK(pieces == whole);
        }
    }

    TEST_CASE("line_number and shown: what an error message says of a place and of a word") {
        const std::string text = "a\nb\n\nc";
        CHECK(bake::line_number(text.data(), text.data()) == 1);
        CHECK(bake::line_number(text.data(), text.data() + 2) == 2);
        CHECK(bake::line_number(text.data(), text.data() + 5) == 4);
        CHECK(bake::shown("word") == "'word'");
        CHECK(bake::shown("tab\there\x7f") == "'tab\\there\\x7f'");
        CHECK(bake::shown(std::string(41, 'x')) == "'" + std::string(40, 'x') + "...'");
    }
} // unit

TEST_SUITE("oracle") {
    TEST_CASE("parse_float: equals the correctly rounded float for thousands of random texts") {
        std::mt19937_64 random(1);
        char text[64];
        for (int i = 0; i < 20000; ++i) {
            const auto bits = std::uint32_t(random());
            float f;
            std::memcpy(&f, &bits, sizeof f);
            if (!std::isfinite(f)) continue;
            check_nearest(std::string(text, std::to_chars(text, text + sizeof text, f).ptr)); // shortest
            std::snprintf(text, sizeof text, "%.9g", double(f));
            check_nearest(text);
            std::snprintf(text, sizeof text, "%.*f", int(random() % 12), double(random() % 2000000) / 1000.0 - 1000);
            check_nearest(text);
            std::snprintf(text, sizeof text, "%llu.%llue%d",
                          static_cast<unsigned long long>(random() >> (random() % 64)),
                          static_cast<unsigned long long>(random() >> (random() % 64)), int(random() % 90) - 50);
            check_nearest(text);
        }
    }

    TEST_CASE("parse_float: texts on, just below and just above the middle of two floats round to the nearest") {
        // Here rounding to double and then to float goes wrong unless the fast way gives up.
        std::mt19937 random(2);
        for (int i = 0; i < 5000; ++i) {
            const float f = float(1 + random() % 16777215) * std::ldexp(1.0f, int(random() % 12) - 8);
            const double middle = (double(f) + double(std::nextafter(f, 1e30f))) / 2;
            char text[64];
            std::snprintf(text, sizeof text, "%.40g", middle); // exact: the middle is a dyadic fraction of few digits
            const std::string exact = text;
            check_nearest(exact);
            const bool point = exact.find('.') != std::string::npos;
            for (const int zeros : {0, 3, 8})
                check_nearest(exact + (point ? "" : ".") + std::string(std::size_t(zeros), '0') + "1");
            std::snprintf(text, sizeof text, "%.17g", std::nextafter(middle, 0.0));
            check_nearest(text);
            std::snprintf(text, sizeof text, "%.17g", std::nextafter(middle, 1e300));
            check_nearest(text);
        }
    }
} // oracle
