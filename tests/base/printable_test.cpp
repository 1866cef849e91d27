#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/base/text_line.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("printable: what a terminal would obey is escaped, text stays") {
        CHECK(printable("a b\\c `d` \"e\"") == "a b\\c `d` \"e\"");
        CHECK(printable("Größe_日本_🙂.png") == "Größe_日本_🙂.png");
        CHECK(printable("a\x1b[31mb") == "a\\x1b[31mb");
        CHECK(printable("a\nb\tc\rd") == "a\\nb\\tc\\rd");
        CHECK(printable(std::string_view("a\0b\x7f", 4)) == "a\\x00b\\x7f");
        CHECK(printable("\xc2\x9b") == "\\xc2\\x9b"); // CSI in one character
        CHECK(printable("a\xe2\x80\xae"
                        "b") == "a\\xe2\\x80\\xae"
                                "b"); // text runs backwards behind it
        CHECK(printable("a\xe2\x80\xa8"
                        "b") == "a\\xe2\\x80\\xa8"
                                "b"); // a line separator
        CHECK(printable_lines("a\nb\x1b\r\n") == "a\nb\\x1b\\r\n");
        CHECK(printable("") == "");
    }

    TEST_CASE("printable: bytes that are not UTF-8 are escaped one by one") {
        for (const char* bad :
             {"\xff", "\x80", "\xc3", "\xe2\x82", "\xf0\x9f\x99", "\xc0\xaf", "\xc1\x81", "\xe0\x80\x80",
              "\xf0\x80\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80"}) {
            const std::string text = printable(std::string(bad) + "a");
            CHECK(text.find_first_not_of("\\x0123456789abcdef") == std::string::npos);
            CHECK(text.size() == 4 * std::string_view(bad).size() + 1);
        }
        CHECK(printable("\xc3(") == "\\xc3(");
        CHECK(printable("\xf4\x8f\xbf\xbf") == "\xf4\x8f\xbf\xbf"); // the last code point
    }

    TEST_CASE("printable: twice is once, so that a name may be escaped before its line is") {
        std::string all;
        for (int c = 0; c < 256; ++c) all += char(c);
        CHECK(printable(printable(all)) == printable(all));
        CHECK(printable_lines(printable(all)) == printable(all));
    }

    TEST_CASE("shown: long text is cut between characters") {
        CHECK(shown(std::string(41, 'a')) == "'" + std::string(40, 'a') + "...'");
        CHECK(shown(std::string(39, 'a') + "é") == "'" + std::string(39, 'a') + "...'");
        CHECK(shown(std::string(60, '\x80')).ends_with("\\x80...'"));
        CHECK(shown("a\nb") == "'a\\nb'");
    }

    TEST_CASE("format: text of any length") {
        CHECK(format("%s: %d", std::string(5000, 'x').c_str(), 7) == std::string(5000, 'x') + ": 7");
        CHECK(format("%%") == "%");
    }

} // TEST_SUITE
