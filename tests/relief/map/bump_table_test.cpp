#include "bake/base/parallel.h"
#include "bake/relief/map/bump_table.h"
#include <cmath>
#include <cstring>
#include <doctest/doctest.h>

using namespace bake;

namespace {

HeightTexture noise(int width, int height) {
    HeightTexture texture;
    texture.values = Image<float>(width, height, 1);
    std::uint32_t state = 7;
    for (std::size_t i = 0; i < texture.values.size(); ++i) {
        state = state * 1664525 + 1013904223;
        texture.values.data()[i] = float(state >> 8) / float(1 << 24);
    }
    texture.levels = 257;
    return texture;
}

std::vector<double> means(const Image<float>& image) {
    std::vector<double> sums(std::size_t(image.channels()), 0.0);
    for (std::size_t i = 0; i < image.size(); ++i) sums[i % sums.size()] += image.data()[i];
    for (double& sum : sums) sum /= double(image.size()) / double(sums.size());
    return sums;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("bump_table: bands are the rows of the whole table, for any threads, sizes and layout") {
        for (const auto& [width, height] : {std::pair(1, 1), {3, 64}, {5, 65}, {2000, 131}, {40, 5000}})
            for (const TableLayout layout : {TableLayout::slopes, TableLayout::bumpslopes}) {
                const HeightTexture texture = noise(width, height);
                const Image<float> whole = bump_table(texture, {}, layout);
                CHECK(whole.channels() == (layout == TableLayout::slopes ? 2 : 6));
                for (const int threads : {1, 3}) {
                    const ThreadLimit limit(threads);
                    const BumpTable table(texture, {}, layout);
                    int y = 0;
                    bool same = true, multiple = true;
                    for_bands(table, [&](const float* values, int rows) {
                        same = same && y + rows <= height &&
                               std::memcmp(values, whole.row(y), sizeof(float) * whole.channels() * width * rows) == 0;
                        y += rows;
                        multiple = multiple && (y == height || rows % 64 == 0);
                    });
                    CHECK(same);
                    CHECK(multiple);
                    CHECK(y == height);
                }
            }
    }

    TEST_CASE("bump_table: units are constant factors of the slope per texel") {
        const HeightTexture texture = noise(24, 12);
        const auto slopes = [&](SlopeUnits units, double amplitude = 1, double extent_u = 0, double extent_v = 0) {
            BumpTableOptions options;
            options.filter = Filter::scharr;
            options.units = units;
            options.amplitude = amplitude;
            options.extent_u = extent_u, options.extent_v = extent_v;
            return bump_table(texture, options);
        };
        const Image<float> texel = slopes(SlopeUnits::texel);
        const auto check = [&](const Image<float>& table, double u, double v) {
            for (std::size_t i = 0; i < table.size(); ++i)
                CHECK(table.data()[i] == doctest::Approx(texel.data()[i] * (i % 2 ? v : u)).epsilon(1e-5));
        };
        check(slopes(SlopeUnits::difference), 2, 2);
        check(slopes(SlopeUnits::uv), 24, 12);
        check(slopes(SlopeUnits::world), 24, 24); // 1 wide, 1/2 high
        check(slopes(SlopeUnits::world, 1, 3), 8, 8);
        check(slopes(SlopeUnits::world, 0.5, 3, 6), 4, 1);
        check(slopes(SlopeUnits::texel, -2), -2, -2);
    }

    TEST_CASE("bump_table: automatic is sobel up to 256 levels and c2 above") {
        HeightTexture texture = noise(4, 4);
        texture.levels = 256;
        CHECK(resolve_filter(Filter::automatic, texture) == Filter::sobel);
        texture.levels = 257;
        CHECK(resolve_filter(Filter::automatic, texture) == Filter::c2);
        CHECK(resolve_filter(Filter::order4, texture) == Filter::order4);
        CHECK(BumpTable(texture, {}).filter() == Filter::c2);
    }

    TEST_CASE("bump_table: moments are the height, the slopes with t down, and their products") {
        const HeightTexture texture = noise(17, 9);
        BumpTableOptions options;
        options.amplitude = 0.25;
        const Image<float> slopes = bump_table(texture, options),
                           moments = bump_table(texture, options, TableLayout::bumpslopes);
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 17; ++x) {
                const float s = slopes.at(x, y, 0), t = -slopes.at(x, y, 1);
                CHECK(moments.at(x, y, 0) == 0.25f * texture.values.at(x, y));
                CHECK(moments.at(x, y, 1) == s);
                CHECK(moments.at(x, y, 2) == t);
                CHECK(moments.at(x, y, 3) == s * s);
                CHECK(moments.at(x, y, 4) == t * t);
                CHECK(moments.at(x, y, 5) == s * t);
            }
    }

    TEST_CASE("bump_table: halving keeps the means of every channel down to one texel, odd sizes too") {
        for (const auto& [width, height] : {std::pair(16, 16), {17, 9}, {1, 13}, {13, 1}, {3, 2}, {101, 67}}) {
            const HeightTexture texture = noise(width, height);
            const BumpTable table(texture, {}, TableLayout::bumpslopes);
            const auto expected = means(bump_table(texture, {}, TableLayout::bumpslopes));
            Image<float> level = halve(table);
            for (int w = std::max(1, width / 2), h = std::max(1, height / 2);;
                 w = std::max(1, w / 2), h = std::max(1, h / 2)) {
                CAPTURE(width);
                CAPTURE(w);
                CHECK(level.width() == w);
                CHECK(level.height() == h);
                const auto now = means(level);
                // Slopes per unit of uv reach the number of texels, their squares its square.
                for (std::size_t c = 0; c < 6; ++c)
                    CHECK(std::abs(now[c] - expected[c]) < 1e-5 * (1 + std::abs(expected[3]) + std::abs(expected[4])));
                if (w == 1 && h == 1) break;
                level = halve(level);
            }
        }
    }

    TEST_CASE("bump_table: halving weighs by area: five texels onto two") {
        Image<float> row(5, 1, 1);
        const float values[] = {1, 2, 4, 8, 16};
        std::copy_n(values, 5, row.data());
        const Image<float> two = halve(row);
        REQUIRE(two.width() == 2);
        CHECK(two.at(0, 0) == doctest::Approx((1 + 2 + 0.5 * 4) / 2.5));
        CHECK(two.at(1, 0) == doctest::Approx((0.5 * 4 + 8 + 16) / 2.5));
    }

    TEST_CASE("bump_table: the range of its 16-bit code is the largest slope of the whole table, of either sign; 1 if "
              "all are 0") {
        HeightTexture texture = noise(50, 300);
        const Image<float> slopes = bump_table(texture, {});
        float most = 0;
        for (std::size_t i = 0; i < slopes.size(); ++i) most = std::max(most, std::abs(slopes.data()[i]));
        CHECK(code_for(BumpTable(texture, {})).range == most);
        std::fill_n(texture.values.data(), texture.values.size(), 0.25f);
        CHECK(code_for(BumpTable(texture, {})).range == 1);
    }

} // TEST_SUITE
