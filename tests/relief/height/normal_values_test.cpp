#include "bake/relief/height/normal_values.h"
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

ImageInfo info_of(SampleType type, int bits, int channels, int alpha = -1) {
    ImageInfo info;
    info.channels.resize(std::size_t(channels));
    info.type = type;
    info.bits = bits;
    info.alpha_channel = alpha;
    return info;
}
const ImageInfo floats = info_of(SampleType::float32, 32, 3), bytes = info_of(SampleType::u8, 8, 3);

Vec3f bumpy(int x, int y) {
    return glm::normalize(Vec3f(0.8f * std::sin(0.4f * float(x)), 0.6f * std::cos(0.3f * float(y)), 1));
}

/// 64 x 48 texels, each given by `store(normal, texel)`.
template <class Store> Image<float> bumps(int channels, const Store& store) {
    Image<float> image(64, 48, channels);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) store(bumpy(x, y), &image.at(x, y));
    return image;
}

/// Stores curve((n + 1) / 2).
template <class Curve> Image<float> curved(const Curve& curve) {
    return bumps(3, [&](const Vec3f& n, float* texel) {
        for (int c = 0; c < 3; ++c) texel[c] = curve(0.5f * n[c] + 0.5f);
    });
}

double worst(const Image<float>& image, const NormalValues& values) {
    const Image<float> vectors = decode_normals(image, values);
    double largest = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest, double(std::abs(vectors.at(x, y, c) - bumpy(x, y)[c])));
    return largest;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("normal_values: one texel a hair below 0 does not make a map signed") {
        Image<float> unorm = curved([](float v) { return v; });
        unorm.at(5, 5, 0) = -0.0001f;
        const NormalValues values = guess_normal_values(unorm, floats);
        CHECK(values.usual());
        unorm.at(5, 5, 0) = 0.5f * bumpy(5, 5).x + 0.5f;
        CHECK(worst(unorm, values) < 1e-6);
    }

    TEST_CASE("normal_values: a signed map is found by its lengths, with and without values below 0, even if they are "
              "short") {
        for (const float length : {1.0f, 0.6f}) {
            const Image<float> image = bumps(3, [&](const Vec3f& n, float* texel) {
                for (int c = 0; c < 3; ++c) texel[c] = length * n[c];
            });
            CHECK(guess_normal_values(image, floats).encoding == NormalEncoding::signed_);
        }
        // Every normal leans to the upper right: no value is below 0.
        const Image<float> leaning = bumps(3, [](const Vec3f& n, float* texel) {
            const Vec3f t = glm::normalize(Vec3f(std::abs(n.x) + 0.1f, std::abs(n.y) + 0.1f, n.z));
            texel[0] = t.x, texel[1] = t.y, texel[2] = t.z;
        });
        CHECK(guess_normal_values(leaning, floats).encoding == NormalEncoding::signed_);
        CHECK(guess_normal_values(leaning, bytes).encoding != NormalEncoding::signed_);
    }

    TEST_CASE("normal_values: z is rebuilt where blue is constant, and from two channels") {
        for (const float blue : {0.0f, 0.5f, 1.0f}) {
            const Image<float> image = bumps(3, [&](const Vec3f& n, float* texel) {
                texel[0] = 0.5f * n.x + 0.5f, texel[1] = 0.5f * n.y + 0.5f, texel[2] = blue;
            });
            const NormalValues values = guess_normal_values(image, bytes);
            CHECK(values.z < 0);
            CHECK(worst(image, values) < 1e-5);
        }
        const Image<float> two = bumps(2, [](const Vec3f& n, float* texel) { texel[0] = n.x, texel[1] = n.y; });
        const NormalValues values = guess_normal_values(two, info_of(SampleType::half, 16, 2));
        CHECK(values.encoding == NormalEncoding::signed_);
        CHECK(worst(two, values) < 1e-5);
        CHECK(describe(values).find("z is rebuilt") != std::string::npos);
    }

    TEST_CASE("normal_values: x in alpha") {
        const Image<float> image = bumps(4, [](const Vec3f& n, float* texel) {
            texel[0] = 1, texel[1] = texel[2] = 0.5f * n.y + 0.5f, texel[3] = 0.5f * n.x + 0.5f;
        });
        const NormalValues values = guess_normal_values(image, info_of(SampleType::u8, 8, 4, 3));
        CHECK(values.x == 3);
        CHECK(worst(image, values) < 1e-5);
    }

    TEST_CASE("normal_values: sRGB-encoded and sRGB-decoded maps are told from plain ones") {
        const auto encode = [](float v) {
            return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
        };
        const auto decode = [](float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); };
        for (const ImageInfo& info : {bytes, floats}) {
            CHECK(guess_normal_values(curved(encode), info).encoding == NormalEncoding::srgb_encoded);
            CHECK(guess_normal_values(curved(decode), info).encoding == NormalEncoding::srgb_decoded);
            CHECK(guess_normal_values(curved([](float v) { return v; }), info).usual());
        }
        CHECK(worst(curved(encode), {.encoding = NormalEncoding::srgb_encoded}) < 1e-4);
        CHECK(worst(curved(decode), {.encoding = NormalEncoding::srgb_decoded}) < 1e-4);
        // A slope that leans as a whole is a normal map all the same.
        Image<float> slope(16, 16, 3);
        for (int i = 0; i < 256; ++i)
            slope.data()[3 * i] = 0.7f, slope.data()[3 * i + 1] = 0.6f, slope.data()[3 * i + 2] = 0.95f;
        slope.at(0, 0, 2) = 0.94f;
        CHECK(guess_normal_values(slope, bytes).usual());
    }

    TEST_CASE("measure_normals: lengths, directions and the mean, of all texels and of a lattice") {
        Image<float> image = bumps(3, [](const Vec3f&, float* texel) { texel[0] = texel[1] = 0.5f, texel[2] = 1; });
        for (int x = 0; x < 64; ++x) image.at(x, 0, 2) = 0; // one row of 48 points inward
        const NormalStats all = measure_normals(image, {});
        CHECK(all.length == doctest::Approx(1));
        CHECK(all.inward == doctest::Approx(1.0 / 48));
        CHECK(all.mean.z == doctest::Approx(46.0 / 48));
        CHECK(all.not_unit == 0);
        CHECK(measure_normals(image, {}, 16).length == doctest::Approx(1));
        CHECK(measure_normals(image, {}, 13).length == doctest::Approx(1));
    }
}
