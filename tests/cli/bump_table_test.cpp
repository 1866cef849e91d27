// bake bump-table from outside: signs, units, borders, encodings and mips on heights whose slopes are known.
#include "bake/base/vec.h"
#include "bake/picture/image_io.h"
#include "bake/relief/map/slope_code.h"
#include "cli/command.h"
#include "picture/png_bytes.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

Image<float> height_of(int width, int height, const auto& value) {
    Image<float> image(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = float(value(x, y));
    return image;
}

/// Runs bump-table on h.exr with these options and reads the table.
Image<float> table(const Folder& folder, std::vector<std::string> options, const std::string& height = "h.exr",
                   std::string* out = nullptr) {
    options.insert(options.begin(), {"bump-table", height, "-o", "t.tif"});
    const Run run = run_bake(folder, options);
    REQUIRE_MESSAGE(run.code == 0, run.err);
    if (out) *out = run.out;
    return read_image(folder / "t.tif");
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("bump-table: positive where the height rises, v up, in every unit, by every filter") {
        const Folder folder;
        // Rises by 1/64 per texel to the right and by 1/128 per texel upwards (row 0 is the top).
        write_image(folder / "h.exr", height_of(16, 8, [](int x, int y) { return x / 64.0 - y / 128.0; }),
                    {.depth = Depth::float32});
        const double u = 1 / 64.0, v = 1 / 128.0;
        struct {
            std::vector<std::string> options;
            double u, v;
        } const cases[] = {{{"--units", "texel"}, u, v},
                           {{"--units", "difference"}, 2 * u, 2 * v},
                           {{"--units", "lecture"}, 2 * u, 2 * v}, // the earlier name
                           {{"--units", "uv"}, 16 * u, 8 * v},
                           {{}, 16 * u, 8 * v},
                           {{"--units", "world"}, 16 * u, 16 * v}, // 1 wide and 1/2 high
                           {{"--units", "world", "--extent", "2,4"}, 8 * u, 2 * v},
                           {{"--units", "world", "--extent", "2,4", "--amplitude", "0.5"}, 4 * u, v},
                           {{"--units", "texel", "--amplitude", "-3"}, -3 * u, -3 * v},
                           {{"--units", "texel", "--invert"}, -u, -v}};
        for (const auto& c : cases) {
            std::vector<std::string> options = c.options;
            options.insert(options.end(), {"--wrap", "clamp"});
            const Image<float> slopes = table(folder, options);
            CAPTURE(c.u);
            // A ramp's slope is the same at the border: a clamped one is one-sided there.
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 16; ++x) {
                    CHECK(slopes.at(x, y, 0) == doctest::Approx(c.u).epsilon(1e-5));
                    CHECK(slopes.at(x, y, 1) == doctest::Approx(c.v).epsilon(1e-5));
                }
        }
        for (const char* filter : {"central", "sobel", "scharr", "order4", "order6", "c2"}) {
            CAPTURE(std::string(filter));
            const Image<float> slopes = table(folder, {"--units", "texel", "--wrap", "clamp", "--filter", filter});
            CHECK(slopes.at(0, 0, 0) == doctest::Approx(u).epsilon(1e-4));
            CHECK(slopes.at(9, 4, 1) == doctest::Approx(v).epsilon(1e-4));
        }
    }

    TEST_CASE("bump-table: --units difference is I(u+1,v) - I(u-1,v), I(u,v+1) - I(u,v-1), borders wrapped per axis") {
        const Folder folder;
        const Image<float> h = height_of(5, 4, [](int x, int y) { return ((x * 7 + y * 13) % 11) / 16.0; });
        write_image(folder / "h.exr", h, {.depth = Depth::float32});
        const auto repeat = [](int i, int n) { return (i + n) % n; };
        const auto mirror = [](int i, int n) { return i < 0 ? -1 - i : i >= n ? 2 * n - 1 - i : i; };
        const auto check = [&](const Image<float>& slopes, const auto& along_u, const auto& along_v) {
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 5; ++x) {
                    CHECK(slopes.at(x, y, 0) == h.at(along_u(x + 1, 5), y) - h.at(along_u(x - 1, 5), y));
                    CHECK(slopes.at(x, y, 1) == h.at(x, along_v(y - 1, 4)) - h.at(x, along_v(y + 1, 4)));
                }
        };
        check(table(folder, {"--units", "difference", "--filter", "central"}), repeat, repeat);
        check(table(folder, {"--units", "difference", "--filter", "central", "--wrap", "mirror"}), mirror, mirror);
        check(table(folder, {"--units", "difference", "--filter", "central", "--wrap-u", "mirror"}), mirror, repeat);
        check(table(folder, {"--units", "difference", "--filter", "central", "--wrap", "mirror", "--wrap-u", "repeat"}),
              repeat, mirror);
    }

    TEST_CASE("bump-table: 16 bits are biased, and decode within half a level by the range that is printed") {
        const Folder folder;
        write_image(
            folder / "h.exr",
            height_of(64, 64,
                      [](int x, int y) { return 0.5 + 0.3 * std::sin(2 * pi * x / 32) * std::cos(2 * pi * y / 16); }),
            {.depth = Depth::float32});
        const Image<float> slopes = table(folder, {});
        for (const char* file : {"b.png", "b.tif", "B.PNG"}) {
            CAPTURE(std::string(file));
            const Run run = run_bake(folder, {"bump-table", "h.exr", "-o", file, "--depth", "16", "--json"});
            REQUIRE(run.code == 0);
            const auto bias = nlohmann::json::parse(run.out)["bias"];
            const double range = bias["range"];
            CHECK(bias["zero_level"] == 32768);
            ImageInfo info;
            const Image<float> stored = read_image(folder / file, &info);
            REQUIRE(slope_code(info.description));
            CHECK(slope_code(info.description)->range == float(range));
            CHECK(stored.channels() ==
                  (std::string(file) == "b.tif" ? 2 : 3)); // two channels of a PNG would be grey and alpha
            double worst = 0, most = 0;
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x)
                    for (int c = 0; c < 2; ++c) {
                        const double back = (std::round(stored.at(x, y, c) * 65535) - 32768) / 32767 * range;
                        worst = std::max(worst, std::abs(back - slopes.at(x, y, c)));
                        most = std::max(most, double(std::abs(slopes.at(x, y, c))));
                    }
            CHECK(most == doctest::Approx(range).epsilon(1e-6));
            CHECK(worst <= 0.501 * range / 32767);
            // The same in words.
            const Run words = run_bake(folder, {"bump-table", "h.exr", "-o", file, "--depth", "16"});
            CHECK(words.out.find("slope = (level - 32768) / 32767 * ") != std::string::npos);
        }
        // A flat height has no range of its own, and its slopes are level 32768.
        write_image(folder / "flat.exr", height_of(8, 8, [](int, int) { return 0.3; }), {});
        REQUIRE(run_bake(folder, {"bump-table", "flat.exr", "-o", "flat.png"}).code == 0);
        CHECK(std::round(read_image(folder / "flat.png").at(3, 3, 1) * 65535) == 32768);
    }

    TEST_CASE("bump-table: one step of an 8-bit height is told as a tilt") {
        const Folder folder;
        write_image(folder / "h.png", height_of(64, 64, [](int x, int) { return x / 63.0; }), {.depth = Depth::u8});
        const Run run =
            run_bake(folder, {"bump-table", "h.png", "-o", "a.exr", "--json", "--amplitude", "0.1", "--extent", "2,2"});
        REQUIRE(run.code == 0);
        const auto object = nlohmann::json::parse(run.out);
        CHECK(object["levels"] == 64);
        CHECK(object["filter"] == "sobel");
        // Levels 4 or 5 of 255 apart: one step is 4/255. Over two of 64 texels on 2 units: 0.1 * (4/255) / (2 * 2/64).
        CHECK(object["step"].get<double>() == doctest::Approx(4 / 255.0).epsilon(1e-5));
        CHECK(object["step_tilt_deg"].get<double>() ==
              doctest::Approx(std::atan(0.1 * 4 / 255 * 64 / 4) * 180 / pi).epsilon(1e-5));
        const Run words =
            run_bake(folder, {"bump-table", "h.png", "-o", "a.exr", "--amplitude", "0.1", "--extent", "2,2"});
        CHECK(words.out.find("one level of the height tilts the normal by ") != std::string::npos);
    }

    TEST_CASE(
        "bump-table: an sRGB tag changes nothing, nor does a tint of one level; alpha is a height by --channel a") {
        const Folder folder;
        std::vector<std::string> grey, tinted, packed;
        for (int y = 0; y < 16; ++y) {
            std::string g, t, p;
            for (int x = 0; x < 16; ++x) {
                const char level = char(128 + 50 * std::sin(2 * pi * x / 16) * std::cos(2 * pi * y / 16));
                g += level;
                t += {level, char(level + 1), char(level + 2)}; // the same everywhere: no slope of its own
                p += {char(x * 16), char(7 * y), char(x ^ y), level};
            }
            grey.push_back(g), tinted.push_back(t), packed.push_back(p);
        }
        write_file(folder / "plain.png", png_bytes(16, 16, 8, 0, grey));
        write_file(folder / "tagged.png", png_bytes(16, 16, 8, 0, grey, srgb_tag()));
        write_file(folder / "tinted.png", png_bytes(16, 16, 8, 2, tinted));
        write_file(folder / "packed.png", png_bytes(16, 16, 8, 6, packed));
        const Image<float> plain = table(folder, {"--units", "texel"}, "plain.png");
        const auto difference = [&](const Image<float>& other) {
            double most = 0;
            for (std::size_t i = 0; i < plain.size(); ++i)
                most = std::max(most, double(std::abs(plain.data()[i] - other.data()[i])));
            return most;
        };
        CHECK(difference(table(folder, {"--units", "texel"}, "tagged.png")) == 0);
        std::string said;
        CHECK(difference(table(folder, {"--units", "texel"}, "tinted.png", &said)) < 1e-6);
        CHECK(said.find("sobel") != std::string::npos); // the tint does not make more levels of it
        CHECK(difference(table(folder, {"--units", "texel", "--channel", "a"}, "packed.png")) == 0);
    }

    TEST_CASE("bump-table: bumpslopes are h, s, t, s2, t2, st per texel, t down, as maketx makes them by Sobel") {
        const Folder folder;
        const Image<float> h = height_of(9, 7, [](int x, int y) { return ((x * 5 + y * 3) % 8) / 8.0; });
        write_image(folder / "h.exr", h, {.depth = Depth::float32});
        REQUIRE(run_bake(folder, {"bump-table", "h.exr", "-o", "b.exr", "--layout", "bumpslopes", "--depth", "float",
                                  "--filter", "sobel"})
                    .code == 0);
        ImageInfo info;
        const Image<float> b = read_image(folder / "b.exr", &info);
        CHECK(info.channels ==
              std::vector<std::string>{"b0_h", "b1_dhds", "b2_dhdt", "b3_dhds2", "b4_dhdt2", "b5_dh2dsdt"});
        for (int y = 1; y < 6; ++y)
            for (int x = 1; x < 8; ++x) {
                const auto at = [&](int i, int j) { return double(h.at(x + i, y + j)); };
                const double s = ((at(1, -1) - at(-1, -1)) + 2 * (at(1, 0) - at(-1, 0)) + (at(1, 1) - at(-1, 1))) / 8;
                const double t = ((at(-1, 1) - at(-1, -1)) + 2 * (at(0, 1) - at(0, -1)) + (at(1, 1) - at(1, -1))) / 8;
                const double expected[] = {at(0, 0), s, t, s * s, t * t, s * t};
                for (int c = 0; c < 6; ++c) CHECK(b.at(x, y, c) == doctest::Approx(expected[c]).epsilon(1e-6));
            }
    }

    TEST_CASE("bump-table: mips of bumpslopes hold the means of the level above, in EXR and TIFF") {
        const Folder folder;
        // h = A sin(wx): the mean slope is 0 and E[s^2] = (A w)^2 / 2 (sin w / w)^2 at every level.
        const double amplitude = 0.25, w = 2 * pi / 16;
        write_image(folder / "h.exr",
                    height_of(128, 32, [&](int x, int) { return 0.5 + amplitude * std::sin(w * (x + 0.5)); }),
                    {.depth = Depth::float32});
        for (const char* file : {"b.exr", "b.tif"}) {
            CAPTURE(std::string(file));
            REQUIRE(run_bake(folder, {"bump-table", "h.exr", "-o", file, "--layout", "bumpslopes", "--depth", "float",
                                      "--filter", "central"})
                        .code == 0);
            const double expected = std::pow(amplitude * std::sin(w), 2) / 2;
            int levels = 0;
            for (Image<float> image; !(image = read_level(folder / file, levels)).empty(); ++levels) {
                CHECK(image.width() == std::max(1, 128 >> levels));
                CHECK(image.height() == std::max(1, 32 >> levels));
                double mean[6] = {};
                for (std::size_t i = 0; i < image.size(); ++i)
                    mean[i % 6] += image.data()[i] / (double(image.size()) / 6);
                CHECK(mean[0] == doctest::Approx(0.5).epsilon(1e-5));
                CHECK(std::abs(mean[1]) < 1e-7);
                CHECK(mean[3] == doctest::Approx(expected).epsilon(1e-5));
                CHECK(std::abs(mean[4]) < 1e-9);
            }
            CHECK(levels == 8);
        }
    }

    TEST_CASE("bump-table: what half floats cannot hold is unsuitable, and float can") {
        const Folder folder;
        write_image(folder / "h.exr", height_of(8, 8, [](int x, int) { return x % 2 ? 1000.0 : 0.0; }),
                    {.depth = Depth::float32});
        const std::vector<std::string> slopes = {"bump-table",  "h.exr", "-o",     "a.exr",
                                                 "--amplitude", "100",   "--wrap", "clamp"};
        check_refused(folder, slopes, 4, "--depth float");
        std::vector<std::string> as_float = slopes;
        as_float.insert(as_float.end(), {"--depth", "float"});
        CHECK(run_bake(folder, as_float).code == 0);
        check_refused(folder, {"bump-table", "h.exr", "-o", "b.exr", "--layout", "bumpslopes", "--wrap", "clamp"}, 4,
                      "--depth float");
    }

} // TEST_SUITE
