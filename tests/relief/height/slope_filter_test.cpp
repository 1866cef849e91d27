#include "bake/base/parallel.h"
#include "bake/relief/height/slope_filter.h"
#include "folders.h"
#include "oracle/surfaces.h"
#include <array>
#include <cstdio>
#include <doctest/doctest.h>
#include <fstream>
#include <map>
#include <random>

using namespace bake;
using bake::test::source_folder;

namespace {

Image<double> picture(int width, int height, const auto& value) {
    Image<double> image(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = value(x, y);
    return image;
}

/// Slopes per texel of the whole image, v up.
std::vector<Vec2d> slopes(const Image<double>& image, Filter filter, Wrap wrap_u, Wrap wrap_v) {
    const SlopeFilter<double> rows(image, filter, wrap_u, wrap_v);
    SlopeFilter<double>::Scratch scratch;
    std::vector<Vec2d> out(image.size());
    for (int y = 0; y < image.height(); ++y) rows.row(y, 1, 1, &out[std::size_t(y) * image.width()].x, scratch);
    return out;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("slope_filter: gains at periods 16, 8 and 4 are those of the table") {
        const struct {
            Filter filter;
            double gain[3];
        } table[] = {{Filter::central, {.9745, .9003, .6366}}, {Filter::sobel, {.9745, .9003, .6366}},
                     {Filter::scharr, {.9745, .9003, .6366}},  {Filter::order4, {.9992, .9882, .8488}},
                     {Filter::order6, {1.0, .9985, .9337}},    {Filter::c2, {.9999, .9977, .9549}}};
        const int periods[] = {16, 8, 4};
        for (const auto& row : table)
            for (int i = 0; i < 3; ++i)
                CHECK(stencil(row.filter).gain(2 * pi / periods[i]) == doctest::Approx(row.gain[i]).epsilon(1e-4));
    }

    TEST_CASE("slope_filter: measured gains equal the closed forms to 1e-6 in both directions") {
        const auto closed_form = [](Filter filter, double w, double w_cross) {
            switch (filter) {
            case Filter::central: return sin(w) / w;
            case Filter::sobel: return sin(w) / w * (1 + cos(w_cross)) / 2;
            case Filter::scharr: return sin(w) / w * (10 + 6 * cos(w_cross)) / 16;
            case Filter::order4: return (8 * sin(w) - sin(2 * w)) / (6 * w);
            case Filter::order6: return (45 * sin(w) - 9 * sin(2 * w) + sin(3 * w)) / (30 * w);
            case Filter::c2: return 3 * sin(w) / (w * (2 + cos(w)));
            default: FAIL("no closed form for this filter: add it to this test"); return 0.0;
            }
        };
        const int n = 48;
        for (const Filter filter : all_filters)
            for (const auto& [k, m] : {std::pair(3, 0), {6, 5}, {12, 2}}) {
                const double w = 2 * pi * k / n, w_cross = 2 * pi * m / n;
                const auto along_u = slopes(picture(n, n, [&](int x, int y) { return sin(w * x) * cos(w_cross * y); }),
                                            filter, Wrap::repeat, Wrap::repeat);
                const auto along_v = slopes(picture(n, n, [&](int x, int y) { return sin(w * y) * cos(w_cross * x); }),
                                            filter, Wrap::repeat, Wrap::repeat);
                CAPTURE(std::string(name(filter)));
                // At (0, 0) the true slopes are w along u, and -w along v, which points up.
                CHECK(std::abs(along_u[0].x / w - closed_form(filter, w, w_cross)) < 1e-6);
                CHECK(std::abs(along_v[0].y / -w - closed_form(filter, w, w_cross)) < 1e-6);
            }
    }

    TEST_CASE("slope_filter: gain and noise of every filter are those of the table in docs/bump-table.md") {
        std::ifstream page(source_folder() / "docs" / "bump-table.md");
        std::map<std::string, std::array<double, 4>> table; // gain of waves of 16, 8 and 4 texels, noise
        for (std::string line; std::getline(page, line);) {
            std::array<double, 4> row;
            char filter[32];
            if (std::sscanf(line.c_str(), "| `%31[^`]` | %lf | %lf | %lf | %lf |", filter, &row[0], &row[1], &row[2],
                            &row[3]) == 5)
                table[filter] = row;
        }
        CHECK(table.size() == all_filters.size());
        for (const Filter filter : all_filters) {
            CAPTURE(std::string(name(filter)));
            REQUIRE(table.contains(std::string(name(filter))));
            const std::array<double, 4> row = table[std::string(name(filter))];
            for (int k = 0; k < 3; ++k) CHECK(std::abs(stencil(filter).gain(2 * pi / (16 >> k)) - row[k]) <= 0.000051);
            CHECK(std::abs(stencil(filter).noise() - row[3]) <= 0.00051);
        }
    }

    TEST_CASE("slope_filter: the border ring is right in every wrap mode") {
        const int n = 64;
        // A wave of whole periods repeats; a cosine about the half-texel border mirrors; both at period 16.
        const double w = 2 * pi / 16;
        for (const Filter filter : all_filters) {
            CAPTURE(std::string(name(filter)));
            const double interior = std::abs(1 - stencil(filter).gain(w));
            const auto repeated = slopes(picture(n, n, [&](int x, int y) { return sin(w * (x + y)); }), filter,
                                         Wrap::repeat, Wrap::repeat);
            const auto mirrored =
                slopes(picture(n, n, [&](int x, int y) { return cos(w * (x + 0.5)) + cos(w * (y + 0.5)); }), filter,
                       Wrap::mirror, Wrap::mirror);
            const auto clamped =
                slopes(picture(n, n, [&](int x, int y) { return sin(w * (x + 0.3)) + sin(w * (y + 0.3)); }), filter,
                       Wrap::clamp, Wrap::clamp);
            double repeat_error = 0, mirror_error = 0, clamp_error = 0;
            for (int i = 0; i < n; ++i)
                for (const auto& [x, y] : {std::pair(0, i), {n - 1, i}, {i, 0}, {i, n - 1}}) {
                    const std::size_t at = std::size_t(y) * n + x;
                    repeat_error = std::max(repeat_error, std::abs(repeated[at].x / w - cos(w * (x + y))));
                    mirror_error = std::max(mirror_error, std::abs(mirrored[at].x / w + sin(w * (x + 0.5))));
                    clamp_error = std::max(clamp_error, std::abs(clamped[at].x / w - cos(w * (x + 0.3))));
                    clamp_error = std::max(clamp_error, std::abs(clamped[at].y / w + cos(w * (y + 0.3))));
                }
            // Sobel and Scharr lose as much again by smoothing across.
            const double lost = interior + std::abs(1 - stencil(filter).gain(w, w) / stencil(filter).gain(w));
            CHECK(repeat_error <= lost * 1.001 + 1e-9);
            CHECK(mirror_error <= lost * 1.001 + 1e-9);
            // One-sided stencils of the same order have larger constants: w^2 / 3 against w^2 / 6 for central.
            const double one_sided = filter == Filter::order4   ? 0.006
                                     : filter == Filter::order6 ? 0.0008
                                     : filter == Filter::c2     ? 0.02
                                                                : 0.06;
            CHECK(clamp_error <= one_sided);
        }
    }
}

TEST_SUITE("oracle") {

    TEST_CASE(
        "slope_filter: polynomials that a filter gets right inside a picture, it gets right at a clamped border") {
        const int n = 48;
        for (const Filter filter : all_filters) {
            CAPTURE(std::string(name(filter)));
            int exact = 0;
            // A spline is right for the fourth degree as well, by a coincidence of its errors that no border keeps.
            const int last = stencil(filter).spline ? 3 : largest_degree;
            for (int degree = 1; degree <= last; ++degree) {
                CAPTURE(degree);
                const double middle = 0.5 * (n - 1), scale = 1 / middle;
                const auto found =
                    slopes(picture(n, n, [&](int x, int) { return std::pow(scale * (x - middle), degree); }), filter,
                           Wrap::clamp, Wrap::clamp);
                const auto error = [&](int x) {
                    const double wanted = degree * scale * std::pow(scale * (x - middle), degree - 1);
                    return std::abs(found[std::size_t(n) * (n / 2) + x].x - wanted) / (degree * scale);
                };
                if (error(3 * n / 4) > 1e-9) break; // the slope of this degree is beyond the filter
                exact = degree;
                for (const int x : {0, 1, 2, 3, n - 4, n - 3, n - 2, n - 1}) CHECK(error(x) < 1e-8);
            }
            CHECK(exact >= 2);
        }
    }
}

TEST_SUITE("unit") {

    TEST_CASE("slope_filter: every filter of the enum has a name, taps, and a border polynomial that is not lowered") {
        for (const Filter filter : all_filters) {
            CAPTURE(int(filter));
            CHECK_FALSE(name(filter).empty());
            const Stencil taps = stencil(filter);
            CHECK(taps.reach() > 0);
            CHECK(taps.border_degree <= largest_degree);
        }
        CHECK(sharp_stencil().border_degree <= largest_degree);
    }

    TEST_CASE("slope_filter: a ramp has its slope everywhere, in every filter and at every clamped border") {
        const auto image = picture(17, 9, [](int x, int y) { return 0.25 * x - 0.5 * y + 3; });
        for (const Filter filter : all_filters)
            for (const Vec2d& slope : slopes(image, filter, Wrap::clamp, Wrap::clamp)) {
                CHECK(slope.x == doctest::Approx(0.25).epsilon(1e-9));
                CHECK(slope.y == doctest::Approx(0.5).epsilon(1e-9)); // v is up
            }
    }

    TEST_CASE("slope_filter: float follows double to float's precision") {
        std::mt19937 random(5);
        std::uniform_real_distribution<float> value(0, 1);
        Image<float> single(33, 21, 1);
        Image<double> twin(33, 21, 1);
        for (std::size_t i = 0; i < single.size(); ++i) twin.data()[i] = single.data()[i] = value(random);
        for (const Filter filter : all_filters)
            for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
                const auto want = slopes(twin, filter, wrap, wrap);
                const SlopeFilter<float> rows(single, filter, wrap, wrap);
                SlopeFilter<float>::Scratch scratch;
                std::vector<float> got(66);
                for (int y = 0; y < 21; ++y) {
                    rows.row(y, 1, 1, got.data(), scratch);
                    // Extrapolated borders amplify rounding by up to a few hundred.
                    const double tolerance = wrap == Wrap::clamp ? 2e-4 : 3e-6;
                    for (int x = 0; x < 33; ++x) {
                        CHECK(std::abs(got[2 * x] - want[std::size_t(y) * 33 + x].x) < tolerance);
                        CHECK(std::abs(got[2 * x + 1] - want[std::size_t(y) * 33 + x].y) < tolerance);
                    }
                }
            }
    }

    TEST_CASE("slope_filter: a stencil with several taps and a side has one meaning in row, at, gain and noise") {
        const Stencil wide{{8.0 / 12, -1.0 / 12}, 0.25, 4};
        const int n = 24;
        const double w = 2 * pi * 3 / n, w_cross = 2 * pi * 5 / n;
        const auto wave = picture(n, n, [&](int x, int y) { return sin(w * x) * cos(w_cross * y); });
        for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
            const SlopeFilter<double> filter(wave, wide, wrap, wrap);
            SlopeFilter<double>::Scratch scratch;
            std::vector<Vec2d> row(n);
            for (int y = 0; y < n; ++y) {
                filter.row(y, 2, 3, &row[0].x, scratch);
                for (int x = 0; x < n; ++x) {
                    const auto [along_u, along_v] = filter.at(x, y, 2, 3);
                    CHECK(std::abs(row[x].x - along_u) < 1e-12);
                    CHECK(std::abs(row[x].y - along_v) < 1e-12);
                }
                if (wrap == Wrap::repeat && y == 0) CHECK(row[0].x / (2 * w) == doctest::Approx(wide.gain(w, w_cross)));
            }
        }
        // The slopes of an impulse are the weights themselves.
        const auto impulse = picture(n, n, [&](int x, int y) { return x == 12 && y == 12; });
        const SlopeFilter<double> filter(impulse, wide, Wrap::repeat, Wrap::repeat);
        SlopeFilter<double>::Scratch scratch;
        std::vector<Vec2d> row(n);
        Vec2d squares(0);
        for (int y = 0; y < n; ++y) {
            filter.row(y, 1, 1, &row[0].x, scratch);
            for (const Vec2d& slope : row) squares += slope * slope;
        }
        CHECK(std::sqrt(squares.x) == doctest::Approx(wide.noise()));
        CHECK(std::sqrt(squares.y) == doctest::Approx(wide.noise()));
    }

    TEST_CASE("slope_filter: more taps than are added at once have the same meaning in row and at, in wide rows too") {
        const Stencil six{{0.85, -0.27, 0.08, -0.02, 0.003, -0.0002}, 0, 6};
        const auto wave = picture(520, 5, [&](int x, int y) { return sin(0.31 * x + 0.7 * y) + 0.2 * cos(1.3 * x); });
        const SlopeFilter<double> filter(wave, six, Wrap::repeat, Wrap::clamp);
        SlopeFilter<double>::Scratch scratch;
        std::vector<Vec2d> row(520);
        double worst = 0;
        for (int y = 0; y < 5; ++y) {
            filter.row(y, 1, 1, &row[0].x, scratch);
            for (int x = 0; x < 520; ++x) {
                const auto [along_u, along_v] = filter.at(x, y, 1, 1);
                worst = std::max(worst, glm::length(row[x] - Vec2d(along_u, along_v)));
            }
        }
        CHECK(worst < 1e-12);
    }

    TEST_CASE("slope_filter: a border degree beyond the largest is lowered alike along u and along v") {
        const Stencil steep{{45.0 / 60, -9.0 / 60, 1.0 / 60}, 0, 11};
        const auto value = [](int x, int y) { return sin(0.9 * x) + 0.3 * cos(1.7 * y + 0.2 * x); };
        const int n = 16;
        const auto upright = picture(n, n, value), turned = picture(n, n, [&](int x, int y) { return value(y, x); });
        const SlopeFilter<double> a(upright, steep, Wrap::clamp, Wrap::clamp),
            b(turned, steep, Wrap::clamp, Wrap::clamp);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                CHECK(a.at(x, y, 1, 1).first == doctest::Approx(-b.at(y, x, 1, 1).second));
                CHECK(a.at(x, y, 1, 1).second == doctest::Approx(-b.at(y, x, 1, 1).first));
            }
    }

    TEST_CASE("slope_filter: the sharp stencil is right to 1e-3 up to four fifths of the highest frequency") {
        for (double w = 0.05; w < 0.78 * pi; w += 0.05) CHECK(std::abs(sharp_stencil().gain(w) - 1) < 1e-3);
    }
}

TEST_SUITE("stability") {

    TEST_CASE("slope_filter: 1 x 1, 1 x N and N x 1 pictures have finite slopes, zero along the single texel") {
        for (const auto& [width, height] : {std::pair(1, 1), {1, 5}, {5, 1}, {2, 2}, {3, 1}})
            for (const Filter filter : all_filters)
                for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
                    for (const Vec2d& slope : slopes(picture(width, height, [](int x, int y) { return x * x + 2 * y; }),
                                                     filter, wrap, wrap)) {
                        CHECK(slope.x * 0 == 0);
                        CHECK(slope.y * 0 == 0);
                        if (width == 1) CHECK(slope.x == doctest::Approx(0));
                        if (height == 1) CHECK(slope.y == doctest::Approx(0));
                    }
    }
}
