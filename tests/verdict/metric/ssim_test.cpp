#include "bake/base/parallel.h"
#include "bake/verdict/metric/ssim.h"
#include "browser.h"
#include "cli/command.h"
#include "verdict/metric/pictures.h"
#include "verdict/metric/plain_ssim.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <doctest/doctest.h>
#include <sstream>

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {
    TEST_CASE("ssim: every window is what the definition gives, and the mean is theirs") {
        // 41 rows: the windows lie in a whole band of rows and a part of one.
        const Image<float> a = picture(29, 45, 1, [](int x, int y, int) { return noise(x, y, 0); });
        const Image<float> b = picture(29, 45, 1, [&](int x, int y, int) { return (a.at(x, y) + noise(x, y, 7)) / 2; });
        const Ssim s = ssim(a, b);
        REQUIRE(s.errors.width() == 19);
        REQUIRE(s.errors.height() == 35);
        double sum = 0;
        for (int y = 0; y < 35; ++y)
            for (int x = 0; x < 19; ++x) {
                const double plain = plain_ssim(a, b, x, y);
                sum += plain;
                REQUIRE(double(s.errors.at(x, y)) == doctest::Approx(1 - plain).epsilon(1e-6));
            }
        CHECK(s.mean == doctest::Approx(sum / (19 * 35)).epsilon(1e-12));
    }

    TEST_CASE("ssim: equal pictures give exactly 1 and no errors, and the order of the two does not matter") {
        const Image<float> a = luma(noisy(40, 30, 1)), b = luma(noisy(40, 30, 2));
        const Ssim same = ssim(a, a);
        CHECK(same.mean == 1);
        for (std::size_t i = 0; i < same.errors.size(); ++i) REQUIRE(same.errors.data()[i] == 0);
        CHECK(ssim(a, b).mean == ssim(b, a).mean);
    }

    TEST_CASE("ssim: constant pictures have the closed form of their means") {
        const auto constant = [](float value) { return picture(16, 16, 1, [=](int, int, int) { return value; }); };
        for (const auto& [a, b] : {std::pair(0.25f, 0.5f), {0.0f, 1.0f}, {0.75f, 0.75f}})
            CHECK(ssim(constant(a), constant(b)).mean ==
                  doctest::Approx((2 * a * b + 1e-4) / (a * a + b * b + 1e-4)).epsilon(1e-9));
    }

    TEST_CASE("ssim: scaled with the peak it stays; pictures of 0 mean and opposite sign come near -1") {
        const Image<float> a = luma(noisy(30, 30, 3)), b = luma(noisy(30, 30, 4));
        const auto scaled = [](const Image<float>& p, double by) {
            return picture(30, 30, 1, [&](int x, int y, int) { return by * p.at(x, y); });
        };
        CHECK(ssim(scaled(a, 256), scaled(b, 256), 256).mean == doctest::Approx(ssim(a, b).mean).epsilon(1e-9));
        const Image<float> wave = picture(30, 30, 1, [](int x, int y, int) { return (x + y) % 2 ? 0.5 : -0.5; });
        CHECK(ssim(wave, scaled(wave, -1)).mean < -0.9);
    }

    TEST_CASE("ssim: luma is that of Rec. 709, grey is itself, alpha is not seen") {
        for (const int channels : {3, 4}) {
            const Image<float> colour =
                picture(1, 1, channels, [](int, int, int c) { return c == 3 ? 0.1 : 0.25 * (c + 1); });
            CHECK(luma(colour).at(0, 0) == doctest::Approx(0.2126 * 0.25 + 0.7152 * 0.5 + 0.0722 * 0.75));
        }
        CHECK(luma(picture(1, 1, 2, [](int, int, int c) { return c ? 1 : 0.375; })).at(0, 0) == 0.375f);
    }

    TEST_CASE("ssim: any number of threads gives the same bits") {
        const Image<float> a = luma(noisy(40, 120, 5)), b = luma(noisy(40, 120, 6));
        const Ssim all = ssim(a, b);
        const ThreadLimit limit(1);
        CHECK(ssim(a, b).mean == all.mean);
        CHECK(equal(ssim(a, b).errors, all.errors));
    }
}

TEST_SUITE("oracle") {
    TEST_CASE("ssim: the values of ssim.js 3.5.0 (ssim: 'original', downsample: false) on pictures of 8 bits") {
        const auto levels = [](const auto& level) {
            return picture(64, 48, 1, [&](int x, int y, int) { return level(x, y) / 255.0; });
        };
        const auto rough = [](int x, int y) { return (x * 7 + y * 13 + ((x * y) % 17) * 5) % 256; };
        const auto shaken = [&](int x, int y) { return std::clamp(rough(x, y) + (x * 31 + y * 57) % 41 - 20, 0, 255); };
        const auto ramp = [](int x, int y) { return std::min(255, 3 * x + 2 * y); };
        const auto half = [](int x, int y) { return (3 * x + 2 * y) >> 1; };
        const auto check = [&](const Ssim& s, double mean, double first, double later) {
            CHECK(s.mean == doctest::Approx(mean).epsilon(1e-5)); // their grey is rounded, in the fifth digit
            CHECK(1 - s.errors.at(0, 0) == doctest::Approx(first).epsilon(1e-4));
            CHECK(1 - s.errors.at(1000 % 54, 1000 / 54) == doctest::Approx(later).epsilon(1e-4));
        };
        check(ssim(levels(rough), levels(shaken)), 0.9645817980090016, 0.9296999515762397, 0.9738876734019436);
        check(ssim(levels(ramp), levels(half)), 0.736517397375708, 0.7307239054487447, 0.7366154202720351);
        check(ssim(levels(rough), levels(ramp)), 0.08660774620919778, 0.07918054141192048, 0.04192382528246683);
    }
}

TEST_SUITE("oracle" *
           doctest::skip(no_browser() || !fs::exists(source_folder() / "build/three_viewer/node_modules/ssim.js"))) {
    TEST_CASE("ssim: the package ssim.js itself on twenty pairs of pictures, from equal ones to unrelated ones") {
        constexpr int width = 64, height = 48, pairs = 20;
        const Folder folder;
        const auto level = [](int pair, bool second, int x, int y) {
            const double own = 255 * noise(x / 3, y / 3, 0, unsigned(pair)),
                         other = 255 * noise(x, y, 1, unsigned(pair));
            return int(second ? own + (other - own) * pair / (pairs - 1.0) : own);
        };
        for (int pair = 0; pair < pairs; ++pair)
            for (const bool second : {false, true}) {
                std::string bytes;
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x) bytes += char(level(pair, second, x, y));
                write_file(folder / ((second ? "b" : "a") + std::to_string(pair)), bytes);
            }
        const std::string command = "'" + (source_folder() / "scripts/three_viewer").string() + "' --run '" +
                                    (source_folder() / "tests/verdict/metric/ssim_js.mjs").string() + "' '" +
                                    folder.path.string() + "' " + std::to_string(width) + " " + std::to_string(height) +
                                    " " + std::to_string(pairs) + " >'" + (folder / "said") + "' 2>&1";
        REQUIRE_MESSAGE(std::system(command.c_str()) == 0, contents(folder / "said"));
        std::istringstream said(contents(folder / "said"));
        for (int pair = 0; pair < pairs; ++pair) {
            double expected = -1;
            const bool printed = bool(said >> expected);
            REQUIRE(printed);
            const auto grey = [&](bool second) {
                return picture(width, height, 1, [&](int x, int y, int) { return level(pair, second, x, y) / 255.0; });
            };
            CAPTURE(pair);
            CHECK(ssim(grey(false), grey(true)).mean == doctest::Approx(expected).epsilon(1e-5));
        }
    }
}
