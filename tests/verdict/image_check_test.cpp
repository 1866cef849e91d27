#include "bake/base/vec.h"
#include "bake/relief/map/error_budget.h"
#include "bake/verdict/image_check.h"
#include "verdict/metric/pictures.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace bake;
using bake::test::picture;

namespace {

ImageInfo info_of(SampleType type, int bits, std::vector<std::string> channels, int alpha = -1) {
    ImageInfo info;
    info.format = "png";
    info.channels = std::move(channels);
    info.type = type;
    info.bits = bits;
    info.alpha_channel = alpha;
    return info;
}

const std::vector<std::string> grey1 = {"Y"}, rgb = {"R", "G", "B"};

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("check_image: range, NaN and Inf per channel") {
        Image<float> image = picture(70, 130, 2, [](int x, int y, int c) { return c == 0 ? x : -y; });
        image.at(3, 100, 0) = std::numeric_limits<float>::quiet_NaN();
        image.at(4, 100, 0) = std::numeric_limits<float>::infinity();
        image.at(5, 100, 0) = -std::numeric_limits<float>::infinity();
        const ImageCheck c = check_image(image, info_of(SampleType::float32, 32, {"a", "b"}));
        CHECK(c.channels[0].nan == 1);
        CHECK(c.channels[0].inf == 2);
        CHECK(c.channels[0].max == 69);
        CHECK(c.channels[0].levels == 70);
        CHECK(c.channels[1].nan + c.channels[1].inf == 0);
        CHECK(c.channels[1].min == -129);
        CHECK(c.channels[1].mean == doctest::Approx(-64.5));
        CHECK(c.kind.looks == Looks::data);
    }

    TEST_CASE("check_image: true depth is the smallest bit depth that represents every level") {
        const auto bits = [](SampleType type, int stored, auto level, double largest) {
            const Image<float> image =
                picture(64, 64, 1, [&](int x, int y, int) { return level(y * 64 + x) / largest; });
            return check_image(image, info_of(type, stored, grey1)).true_bits;
        };
        CHECK(bits(
                  SampleType::u16, 16, [](int i) { return i % 4096 * 16.0 + i % 7; }, 65535) == 16);
        CHECK(bits(
                  SampleType::u16, 16, [](int i) { return i % 256 * 257.0; }, 65535) == 8); // 8 bits, stretched
        CHECK(bits(
                  SampleType::u16, 16, [](int i) { return i % 256 * 256.0; }, 65535) == 8); // 8 bits, shifted
        CHECK(bits(
                  SampleType::u16, 16, [](int i) { return std::round(i % 1024 * 65535.0 / 1023); }, 65535) == 10);
        CHECK(bits(
                  SampleType::u8, 8, [](int i) { return i % 256; }, 255) == 8);
        CHECK(bits(
                  SampleType::u8, 8, [](int i) { return i % 2 * 255; }, 255) == 1);
        CHECK(bits(
                  SampleType::float32, 32, [](int i) { return i % 256; }, 255) == 8); // floats converted from bytes
        CHECK(bits(
                  SampleType::float32, 32, [](int i) { return std::sin(i * 0.1) * 0.5 + 0.5; }, 1) == 0);
    }

    TEST_CASE("check_image: genuine floats have no integer depth, floats from integers have theirs") {
        const auto bits = [](SampleType type, auto value) {
            const Image<float> image = picture(64, 64, 1, [&](int x, int y, int) { return value(y * 64 + x); });
            return check_image(image, info_of(type, type == SampleType::half ? 16 : 32, grey1)).true_bits;
        };
        std::uint32_t seed = 1;
        const auto random = [&seed](int) {
            seed = seed * 1664525u + 1013904223u;
            return 0.5 + double(seed >> 8) / (1 << 25);
        };
        CHECK(bits(SampleType::float32, random) == 0);
        CHECK(bits(SampleType::half, [&](int i) { return as_half(float(random(i))); }) == 0);
        CHECK(bits(SampleType::half, [](int i) { return as_half(float(i % 256) / 255); }) == 8);
        CHECK(bits(SampleType::float32, [](int i) { return as_half(float(i % 256) / 255); }) == 8);
        CHECK(bits(SampleType::float32, [](int i) { return i % 4096 / 4095.0; }) == 12);
        CHECK(bits(SampleType::float32, [](int i) { return i * 16 / 65535.0; }) == 16);
    }

    TEST_CASE("check_image: n bits hold at most 2^n values, however near to each other these are") {
        for (const int levels : {1, 3, 7, 255}) {
            const Image<float> image = picture(64, 64, 1, [&](int x, int y, int) {
                const int i = (y * 64 + x) % (levels + 2);
                return i <= levels ? double(i) / levels : 1 - 0x1p-24;
            });
            const ImageCheck c = check_image(image, info_of(SampleType::float32, 32, grey1));
            CHECK(c.channels[0].levels == levels + 2);
            if (c.true_bits > 0) CHECK(std::exp2(c.true_bits) >= levels + 2);
        }
    }

    TEST_CASE("check_image: the depth of a palette's indices is not that of its colours") {
        const auto bits = [](int stored, auto level) {
            const Image<float> image = picture(64, 64, 1, [&](int x, int y, int) { return level(y * 64 + x) / 255.0; });
            return check_image(image, info_of(SampleType::u8, stored, grey1)).true_bits;
        };
        CHECK(bits(2, [](int i) { return i % 161 + 40; }) == 8);            // as a palette of TGA
        CHECK(bits(4, [](int i) { return (i % 16) * (i % 16) + 3; }) == 8); // sixteen entries of eight bits
        CHECK(bits(4, [](int i) { return i % 16 * 17; }) == 4);
    }

    TEST_CASE("check_image: the header's depth holds if its values were spread to the samples by cutting digits off") {
        const auto image = picture(
            64, 64, 1, [](int x, int y, int) { return std::floor((y * 64 + x) % 1024 * 65535.0 / 1023) / 65535; });
        CHECK(check_image(image, info_of(SampleType::u16, 16, grey1)).true_bits == 16);
        CHECK(check_image(image, info_of(SampleType::u16, 10, grey1)).true_bits == 10);
        CHECK(check_image(image, info_of(SampleType::u16, 9, grey1)).true_bits == 16);
    }

    TEST_CASE("check_image: samples that the reader cut, and signed integers") {
        const auto grey = [](SampleType type, int bits, double largest) {
            return check_image(picture(64, 64, 1, [&](int x, int y, int) { return (x + y) % 101 / largest; }),
                               info_of(type, bits, grey1));
        };
        CHECK(is_cut(grey(SampleType::u8, 16, 255).info));
        CHECK_FALSE(is_cut(grey(SampleType::u8, 8, 255).info));
        CHECK(grey(SampleType::i16, 16, 32767).grey_step == doctest::Approx(1.0 / 32767));
        CHECK(grey(SampleType::i16, 16, 32767).true_bits == 16);
    }

    TEST_CASE("check_image: levels are counted up to 65536") {
        const auto levels = [](int count, SampleType type, int bits) {
            const Image<float> image =
                picture(512, 256, 1, [&](int x, int y, int) { return (y * 512 + x) % count / 131071.0; });
            return check_image(image, info_of(type, bits, grey1)).channels[0].levels;
        };
        CHECK(levels(65536, SampleType::float32, 32) == 65536);
        CHECK(levels(65537, SampleType::float32, 32) == most_levels + 1);
    }

    TEST_CASE("check_image: a slight tint is grey, a colour is not, and alpha is ignored") {
        const auto look = [](auto tint) {
            return check_image(
                picture(32, 32, 3, [&](int x, int y, int c) { return (x * 4 + y + tint(x, y, c)) / 255.0; }),
                info_of(SampleType::u8, 8, rgb));
        };
        CHECK(look([](int, int, int) { return 0; }).kind.tint == 0);
        const ImageCheck tinted = look([](int x, int, int c) { return c == 1 && x % 3 == 0; });
        CHECK(tinted.kind.tint == doctest::Approx(1));
        CHECK(tinted.kind.looks == Looks::grey);
        CHECK(look([](int, int, int c) { return c * 20; }).kind.looks == Looks::colour);
        // A height in R = G = B with a varied alpha.
        const ImageCheck packed =
            check_image(picture(32, 32, 4, [](int x, int y, int c) { return (c == 3 ? y : x) / 31.0; }),
                        info_of(SampleType::u8, 8, {"R", "G", "B", "A"}, 3));
        CHECK(packed.kind.looks == Looks::grey);
        CHECK(packed.kind.tint == 0);
    }

    TEST_CASE("check_image: the grey value has the levels of the sum of the channels") {
        // On every other texel R is one level above G and B: 20 levels of the mean, 11 of red.
        const ImageCheck c =
            check_image(picture(40, 10, 3, [](int x, int y, int c_) { return (100 + y + (c_ == 0 && x % 2)) / 255.0; }),
                        info_of(SampleType::u8, 8, rgb));
        CHECK(c.channels[0].levels == 11);
        CHECK(c.grey.levels == 20);
        CHECK(c.grey_step == doctest::Approx(1 / 255.0));
    }

    TEST_CASE("check_image: tiling per axis") {
        const ImageCheck wave = check_image(
            picture(64, 48, 1, [](int x, int y, int) { return 0.5 + 0.2 * std::sin(2 * pi * x / 64) + 0.3 * y / 48; }),
            info_of(SampleType::float32, 32, grey1));
        CHECK(wave.tiling.x.tiles());
        CHECK(wave.tiling.y.ratio() == doctest::Approx(47).epsilon(0.01));
        const ImageCheck flat =
            check_image(picture(8, 8, 1, [](int, int, int) { return 0.25; }), info_of(SampleType::u8, 8, grey1));
        CHECK(flat.tiling.x.ratio() == 0);
        CHECK(flat.kind.looks == Looks::constant);
        const ImageCheck texel =
            check_image(picture(1, 1, 1, [](int, int, int) { return 0.25; }), info_of(SampleType::u8, 8, grey1));
        CHECK(texel.tiling.y.ratio() == 0);
    }

    TEST_CASE("check_image: normal maps are distinguished from colours, even without unit length") {
        const auto normals = [](double length) {
            return check_image(picture(64, 64, 3,
                                       [&](int x, int y, int c) {
                                           const double sx = std::sin(0.4 * x), sy = std::cos(0.3 * y),
                                                        z = 1 / std::sqrt(sx * sx + sy * sy + 1);
                                           const double n[3] = {sx * z, sy * z, z};
                                           return std::round((n[c] * length * 0.5 + 0.5) * 255) / 255;
                                       }),
                               info_of(SampleType::u8, 8, rgb));
        };
        const ImageCheck unit = normals(1);
        CHECK(unit.kind.looks == Looks::normal_map);
        CHECK(unit.kind.normals.not_unit < 0.01);
        CHECK(unit.kind.normals.inward == 0);
        const ImageCheck shorter = normals(0.6);
        CHECK(shorter.kind.looks == Looks::normal_map);
        CHECK(shorter.kind.normals.not_unit == 1);
        CHECK(shorter.kind.normals.length == doctest::Approx(0.6).epsilon(0.01));
    }

    TEST_CASE("step_slope: the smallest step is 21.9 degrees at 4096 texels, 8 bits and a height of 5 % of the width") {
        CHECK(step_slope(1 / 255.0, 4096, 0.05).angle_deg == doctest::Approx(21.9).epsilon(0.002));
        CHECK(step_slope(1 / 65535.0, 4096, 0.05).angle_deg == doctest::Approx(0.09).epsilon(0.02));
        const StepSlope s = step_slope(1 / 255.0, 512);
        CHECK(s.slope == doctest::Approx(512 / 510.0));
        CHECK(step_slope(1 / 255.0, 512, s.one_degree_amplitude).angle_deg == doctest::Approx(1));
        CHECK(step_slope(0, 512).one_degree_amplitude == 0);
    }
}
