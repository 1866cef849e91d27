// Changes at places of a text.
#include "bake/verdict/plan/text_edits.h"
#include "bake/verdict/plan/toml_string.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("text edits: places count characters, not bytes, behind a byte order mark and in lines of both kinds") {
        const std::string text = "\xef\xbb\xbf"
                                 "a\r\n\xc3\xa9\xc3\xa9x\nlast";
        const TextEdits edits(text);
        CHECK(text[edits.offset({1, 1})] == 'a');
        CHECK(text[edits.offset({2, 3})] == 'x');
        CHECK(text[edits.offset({3, 2})] == 'a');
        CHECK(edits.offset({9, 1}) == text.size());
        CHECK(edits.newline(edits.offset({1, 1})) == "\r\n");
        CHECK(edits.newline(edits.offset({2, 1})) == "\n");
        CHECK(text.substr(0, edits.line_end(3)) == "\xef\xbb\xbf"
                                                   "a");
        CHECK(edits.line_end(edits.offset({3, 1})) == text.size());
        CHECK(edits.line_begin(edits.offset({2, 3})) == edits.offset({2, 1}));
    }

    TEST_CASE("text edits: none changes nothing; those at one place keep their order; a part has its own alone") {
        const std::string text = "one two three";
        TextEdits edits(text);
        CHECK(edits.apply() == text);
        edits.replace({8, 13}, "3");
        edits.insert(3, ",");
        edits.insert(3, ";");
        edits.replace({0, 3}, "1");
        CHECK(edits.apply() == "1,; two 3");
        CHECK(edits.apply({4, 13}) == "two 3");
        CHECK(edits.apply({4, 10}) == "two th");
    }

    TEST_CASE("toml_string: quotes, backslashes and control characters are escaped, letters are not") {
        CHECK(toml_string("a\"b\\c\n\x1b\x7f\xc3\xa9") == "\"a\\\"b\\\\c\\u000a\\u001b\\u007f\xc3\xa9\"");
    }
}
