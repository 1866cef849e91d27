#include "bake/verdict/chart/glyphs.h"
#include <cstring>
#include <doctest/doctest.h>
#include <string>

using namespace bake;

namespace {

bool equal(const Glyph& a, const Glyph& b) { return std::memcmp(a.rows, b.rows, sizeof a.rows) == 0; }

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("glyphs: all printable characters are distinct, and none but the space is empty") {
        for (char a = ' '; a <= '~'; ++a) {
            for (char b = char(a + 1); b <= '~'; ++b) CHECK_FALSE(equal(glyph_of(a), glyph_of(b)));
            CHECK_FALSE(equal(glyph_of(a), glyph_of('\n')));
            bool any = false;
            for (int y = 0; y < glyph_height; ++y)
                for (int x = 0; x < glyph_width; ++x) any = any || covers(glyph_of(a), x, y);
            CHECK(any == (a != ' '));
        }
    }

    TEST_CASE("glyphs: what is not printable ASCII is a box") {
        for (const char c : std::string("\0\n\x7f\x80\xff", 5)) CHECK(equal(glyph_of(c), glyph_of('\t')));
        for (int y = 1; y <= 7; ++y)
            for (int x = 0; x < 5; ++x) CHECK(covers(glyph_of('\t'), x, y) == (x == 0 || x == 4 || y == 1 || y == 7));
    }

    TEST_CASE("glyphs: letters do not touch: the last column and the first row are empty, capitals stand on row 7") {
        for (char c = ' '; c <= '~'; ++c) {
            for (int y = 0; y < glyph_height; ++y) CHECK_FALSE(covers(glyph_of(c), 5, y));
            for (int x = 0; x < glyph_width; ++x) CHECK_FALSE(covers(glyph_of(c), x, 0));
        }
        for (char c = 'A'; c <= 'Z'; ++c) {
            CHECK(glyph_of(c).rows[0] != 0);
            CHECK(glyph_of(c).rows[6] != 0);
            CHECK(glyph_of(c).rows[7] == 0);
        }
        // Only these have rows below the line.
        for (char c = ' '; c <= '~'; ++c)
            CHECK((glyph_of(c).rows[7] != 0 || glyph_of(c).rows[8] != 0) ==
                  (std::string(",;_gjpqy|").find(c) != std::string::npos));
        // A letter by hand.
        const Glyph& t = glyph_of('T');
        for (int x = 0; x < 5; ++x) CHECK(covers(t, x, 1));
        for (int y = 2; y <= 7; ++y)
            for (int x = 0; x < 5; ++x) CHECK(covers(t, x, y) == (x == 2));
    }

    TEST_CASE("glyphs: no bit of a letter has changed since all were looked at") {
        std::uint32_t hash = 2166136261; // FNV-1a
        for (char c = ' '; c <= '~'; ++c)
            for (const std::uint8_t row : glyph_of(c).rows) hash = (hash ^ row) * 16777619;
        CHECK(hash == 0xa85fd27f); // a letter was drawn anew? Look at it, and write down the new number
    }
}
