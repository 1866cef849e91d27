#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include "bake/picture/bc5.h"
#include <cstdint>
#include <cstring>
#include <doctest/doctest.h>
#include <functional>
#include <limits>

using namespace bake;

namespace {

Image<float> picture(int width, int height, const std::function<Vec2d(int x, int y)>& value) {
    Image<float> image(width, height, 2);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec2d v = value(x, y);
            image.at(x, y, 0) = float(v.x), image.at(x, y, 1) = float(v.y);
        }
    return image;
}

Image<float> back(const Image<float>& image) {
    Image<float> decoded(image.width(), image.height(), 2);
    const std::string blocks = bc5_encode(image);
    REQUIRE(blocks.size() == bc5_bytes(image.width(), image.height()));
    bc5_decode(blocks.data(), decoded);
    return decoded;
}

/// Root mean square of the differences, in levels of 8 bits.
double rms_levels(const Image<float>& a, const Image<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(127.5 * (double(a.data()[i]) - double(b.data()[i])), 2);
    return std::sqrt(sum / double(a.size()));
}

/// The smallest rms that any ends and indices reach for one channel of one block, by trying all.
double least_rms(const Image<float>& block) {
    double least = std::numeric_limits<double>::max();
    for (int a = 0; a < 256; ++a)
        for (int b = 0; b < 256; ++b) {
            double sum = 0;
            for (int i = 0; i < 16; ++i) {
                const double v = 127.5 * (double(block.at(i % 4, i / 4)) + 1);
                double nearest = a > b ? 1e9 : std::min(v, 255 - v);
                const int steps = a > b ? 7 : 5;
                for (int k = 0; k <= steps; ++k)
                    nearest = std::min(nearest, std::abs(v - (a + (b - a) * double(k) / steps)));
                sum += nearest * nearest;
            }
            least = std::min(least, sum);
        }
    return std::sqrt(least / 16);
}

/// Values in [-1,1) that look random.
double hash(int x, int y) {
    std::uint32_t h = std::uint32_t(x) * 0x9e3779b1u ^ std::uint32_t(y) * 0x85ebca6bu;
    h ^= h >> 15, h *= 0x2c1b3c6du, h ^= h >> 12, h *= 0x297a2d39u, h ^= h >> 15;
    return double(h) / 2147483648.0 - 1;
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("bc5_encode: within 2 % of the best ends and indices there are, over blocks of all ranges") {
        double ours = 0, best = 0;
        for (const double range : {0.002, 0.01, 0.03, 0.1, 0.3, 0.5})
            for (int k = 0; k < 6; ++k) {
                const auto block = picture(4, 4, [&](int x, int y) {
                    const double v = 0.4 * hash(k, 77) + range * (0.7 * (x + 0.4 * y) / 4 + 0.3 * hash(x + 4 * y, k));
                    return Vec2d(v, v);
                });
                const double found = rms_levels(block, back(block)), least = least_rms(block);
                CAPTURE(range);
                CAPTURE(k);
                CHECK(found > 0.999 * least); // the oracle is one
                CHECK(found < 1.2 * least + 0.002);
                ours += found / least, best += 1;
            }
        MESSAGE("mean ratio to the optimum " << ours / best);
        CHECK(ours / best < 1.02);
    }
    TEST_CASE("bc5_decode: the values that the format defines") {
        char blocks[16] = {};
        const auto set = [&](int a, int b) {
            blocks[0] = char(a), blocks[1] = char(b);
            const std::uint64_t bits = 0xfac688; // texels 0 to 7 have the indices 0 to 7
            for (int i = 0; i < 6; ++i) blocks[2 + i] = char(bits >> 8 * i);
        };
        Image<float> out(4, 4, 2);
        const auto check = [&](const std::vector<double>& levels) {
            bc5_decode(blocks, out);
            for (int i = 0; i < 8; ++i)
                CHECK(127.5 * (double(out.at(i % 4, i / 4)) + 1) ==
                      doctest::Approx(levels[std::size_t(i)]).epsilon(1e-5));
            for (int i = 8; i < 16; ++i)
                CHECK(127.5 * (double(out.at(i % 4, i / 4)) + 1) == doctest::Approx(levels[0]).epsilon(1e-5));
            CHECK(out.at(2, 2, 1) == -1); // all bytes 0
        };
        set(240, 100);
        check({240, 100, 220, 200, 180, 160, 140, 120});
        set(100, 150);
        check({100, 150, 110, 120, 130, 140, 0, 255});
    }
}

TEST_SUITE("unit") {
    TEST_CASE("bc5_encode: smooth waves are stored finer than 8 bits") {
        // A part of 1024 x 1024 texels with 5 x 4 waves of slope .3.
        const auto waves = picture(256, 256, [](int x, int y) {
            const double u = 2 * pi * 5 * x / 1024, v = 2 * pi * 4 * y / 1024;
            const Vec3d n(-0.3 * std::cos(u) * std::sin(v), -0.24 * std::sin(u) * std::cos(v), 1);
            return Vec2d(glm::normalize(n));
        });
        const double rms = rms_levels(waves, back(waves));
        CHECK(rms < 0.109); // rounding to levels: 1 / sqrt 12 = .289
    }
    TEST_CASE("bc5_encode: values that the format has are kept: extremes, constants, and six steps beside 0 and 1") {
        for (const double v : {-1.0, 1.0, 60 / 127.5 - 1, 200 / 127.5 - 1}) {
            const auto constant = picture(4, 4, [&](int, int) { return Vec2d(v, -v); });
            CHECK(rms_levels(constant, back(constant)) < 1e-3);
        }
        const auto mixed = picture(4, 4, [](int x, int y) {
            const double level = x == 0 ? 0 : x == 3 ? 255 : 100 + 10 * ((x + 2 * y) % 6);
            return Vec2d(level / 127.5 - 1, 0);
        });
        const auto decoded = back(mixed);
        for (int i = 0; i < 16; ++i)
            CHECK(double(decoded.at(i % 4, i / 4)) == doctest::Approx(double(mixed.at(i % 4, i / 4))).epsilon(1e-4));
    }
    TEST_CASE("bc5_encode: odd sizes repeat their last texels, and NaN and values beyond the range give no noise") {
        for (const auto& [width, height] : {std::pair(1, 1), std::pair(5, 3), std::pair(6, 9), std::pair(2, 7)}) {
            const auto ramp = picture(width, height, [](int x, int y) { return Vec2d(0.01 * x, 0.01 * y - 0.5); });
            CHECK(rms_levels(ramp, back(ramp)) < 0.3);
        }
        // The columns that are repeated would otherwise widen the block's range.
        const auto narrow = picture(5, 4, [](int x, int y) { return Vec2d(x == 4 ? 0.004 * y : hash(x, y), 0); });
        const auto decoded = back(narrow);
        for (int y = 0; y < 4; ++y) CHECK(std::abs(double(decoded.at(4, y)) - 0.004 * y) < 0.0015);

        const auto wild = picture(4, 4, [](int x, int) {
            const double values[] = {std::numeric_limits<double>::quiet_NaN(), -5, 7,
                                     std::numeric_limits<double>::infinity()};
            return Vec2d(values[x], 0);
        });
        const auto tame = back(wild);
        for (int x = 0; x < 4; ++x) CHECK(tame.at(x, 1) == doctest::Approx(x < 2 ? -1 : 1));
    }
    TEST_CASE("bc5_decode: a third channel gets z, at least 0") {
        Image<float> normals(4, 1, 3);
        const float xy[4][2] = {{0, 0}, {0.6f, 0}, {0, -0.8f}, {1, 1}};
        for (int x = 0; x < 4; ++x)
            for (int c = 0; c < 2; ++c) normals.at(x, 0, c) = xy[x][c];
        bc5_decode(bc5_encode(normals).data(), normals);
        for (int x = 0; x < 4; ++x) {
            const float *n = &normals.at(x, 0), z2 = 1 - n[0] * n[0] - n[1] * n[1];
            CHECK(n[2] == doctest::Approx(std::sqrt(std::max(0.0f, z2))));
        }
        CHECK(normals.at(3, 0, 2) == 0);
    }
    TEST_CASE("bc5_encode: the same bytes for any number of threads") {
        const auto noise = picture(70, 50, [](int x, int y) { return Vec2d(hash(x, y), 0.1 * hash(y, x)); });
        const std::string all = bc5_encode(noise);
        const ThreadLimit one(1);
        CHECK(bc5_encode(noise) == all);
    }
}
