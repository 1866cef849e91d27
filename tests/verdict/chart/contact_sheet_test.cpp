#include "bake/base/error.h"
#include "bake/verdict/chart/contact_sheet.h"
#include "bake/verdict/chart/glyphs.h"
#include "verdict/metric/pictures.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

std::vector<SheetTile> tiles(int count, int width, int height) {
    std::vector<SheetTile> out;
    for (int i = 0; i < count; ++i) {
        SheetTile tile;
        tile.caption = {"tile " + std::to_string(i)};
        tile.picture = test::noisy(width, height, unsigned(i) + 1);
        out.push_back(std::move(tile));
    }
    return out;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("contact_sheet: each picture is in the sheet, pixel by pixel, and no two share a place") {
        for (const int count : {1, 2, 5, 10})
            for (const int columns : {0, 1, 3}) {
                std::vector<SheetTile> input = tiles(count, 61, 40);
                input[0].caption = {"one", "two", "three"};
                SheetOptions options;
                options.columns = columns;
                options.title = count == 5 ? "" : "title";
                const SheetLayout layout = sheet_layout(input, options);
                const Image<float> sheet = contact_sheet(input, options);
                REQUIRE(sheet.channels() == 3);
                REQUIRE(sheet.width() == layout.width);
                REQUIRE(sheet.height() == layout.height);
                CHECK(layout.columns * layout.rows >= count);
                if (columns > 0) CHECK(layout.columns == std::min(columns, count));
                std::size_t same = 0;
                for (int i = 0; i < count; ++i) {
                    const int left = layout.left(i), top = layout.top(i);
                    REQUIRE((left >= 0 && top >= 0 && left + 61 <= sheet.width() && top + 40 <= sheet.height()));
                    for (int y = 0; y < 40; ++y)
                        for (int x = 0; x < 61; ++x)
                            for (int c = 0; c < 3; ++c)
                                same += sheet.at(left + x, top + y, c) == input[std::size_t(i)].picture.at(x, y, c);
                }
                CHECK(same == std::size_t(count) * 61 * 40 * 3);
            }
    }

    TEST_CASE("contact_sheet: a caption is drawn above its picture, letter by letter, at the size of the tile") {
        for (const int width : {100, 240, 500}) {
            std::vector<SheetTile> input = tiles(1, width, 20);
            input[0].caption = {"Ag"};
            const SheetLayout layout = sheet_layout(input);
            CHECK(layout.text_scale == std::max(1, width / 216));
            const Image<float> sheet = contact_sheet(input);
            const int s = layout.text_scale, base = layout.top(0) - 2 * s - glyph_height * s;
            for (int y = 0; y < (glyph_height + 2) * s; ++y) // and nothing between the caption and the picture
                for (int x = 0; x < 2 * glyph_width * s; ++x) {
                    const bool ink = y < glyph_height * s &&
                                     covers(glyph_of("Ag"[x / (glyph_width * s)]), x / s % glyph_width, y / s);
                    CHECK((sheet.at(layout.left(0) + x, base + y) < 0.5f) == ink);
                }
        }
    }

    TEST_CASE("contact_sheet: a caption that is too wide stays above its own picture") {
        std::vector<SheetTile> input = tiles(2, 60, 20);
        input[0].caption = {std::string(200, 'W')};
        input[1].caption = {""};
        SheetOptions options;
        options.columns = 2;
        const SheetLayout layout = sheet_layout(input, options);
        const Image<float> sheet = contact_sheet(input, options);
        bool ink = false;
        for (int y = 0; y < layout.top(0); ++y)
            for (int x = layout.left(0) + 60; x < layout.width; ++x) ink = ink || sheet.at(x, y) < 1;
        CHECK_FALSE(ink);
    }

    TEST_CASE("contact_sheet: about 1.5 times as wide as high, for any number of tiles and shape") {
        for (const int count : {4, 6, 9, 10, 12, 20, 30})
            for (const double shape : {0.5, 1.0, 16.0 / 9}) {
                const SheetLayout layout = sheet_layout(tiles(count, int(64 * shape), 64));
                CAPTURE(count);
                CAPTURE(shape);
                CHECK(double(layout.width) / layout.height > 0.6);
                CHECK(double(layout.width) / layout.height < 3.2);
            }
    }

    TEST_CASE("contact_sheet: none is an empty picture; other sizes and channels are refused") {
        CHECK(contact_sheet({}).empty());
        std::vector<SheetTile> input = tiles(2, 20, 20);
        input[1].picture = test::noisy(20, 21, 1);
        CHECK_THROWS_AS(contact_sheet(input), Error);
        input[1].picture = test::picture(20, 20, 1, [](int, int, int) { return 0.5; });
        CHECK_THROWS_AS(contact_sheet(input), Error);
    }
}
