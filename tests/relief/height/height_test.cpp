#include "bake/base/error.h"
#include "bake/relief/height/dequantise.h"
#include "bake/relief/height/height.h"
#include "oracle/surfaces.h"
#include <doctest/doctest.h>
#include <filesystem>
#include <random>
#include <unistd.h>

using namespace bake;

namespace {

Image<double> wave_picture(int width, int height) {
    Image<double> image(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = 0.5 + 0.4 * sin(2 * pi * (x + 0.5) / width) * cos(2 * pi * (y + 0.5) / height);
    return image;
}

constexpr Interpolation all_interpolations[] = {Interpolation::bilinear, Interpolation::catmull_rom, Interpolation::c2};

std::string temporary(const char* name) {
    return (std::filesystem::temp_directory_path() / ("bake_" + std::to_string(getpid()) + "_" + name)).string();
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("height sampler: passes through the texel centres, in every wrap mode") {
        const Image<double> image = wave_picture(16, 12);
        for (const Interpolation interpolation : all_interpolations)
            for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
                const HeightSampler<double> sampler(image, interpolation,
                                                    {.amplitude = 2, .midlevel = 0.25, .wrap_u = wrap, .wrap_v = wrap});
                for (int y = 0; y < 12; ++y)
                    for (int x = 0; x < 16; ++x)
                        CHECK(sampler.at((x + 0.5) / 16, 1 - (y + 0.5) / 12).b ==
                              doctest::Approx(2 * (image.at(x, y) - 0.25)).epsilon(1e-9));
            }
    }

    TEST_CASE("height sampler: slopes are the derivatives of the value, across borders and in mirrored tiles too") {
        const Image<double> image = wave_picture(16, 12);
        std::mt19937 random(1);
        std::uniform_real_distribution<double> number(-1.5, 2.5);
        for (const Interpolation interpolation : all_interpolations)
            for (const Wrap wrap : {Wrap::repeat, Wrap::mirror}) {
                const HeightSampler<double> sampler(image, interpolation, {.wrap_u = wrap, .wrap_v = wrap});
                for (int i = 0; i < 300; ++i) {
                    const double u = number(random), v = number(random), e = 1e-6;
                    // Away from the knots, where bilinear slopes jump.
                    const double x = u * 16 - 0.5, y = v * 12 - 0.5;
                    if (std::abs(x - std::round(x)) < 1e-3 || std::abs(y - std::round(y)) < 1e-3) continue;
                    if (std::abs(u - std::round(u)) < 1e-3 || std::abs(v - std::round(v)) < 1e-3) continue;
                    const Height<double> h = sampler.at(u, v);
                    CHECK(std::abs(h.b_u - (sampler.at(u + e, v).b - sampler.at(u - e, v).b) / (2 * e)) < 1e-6);
                    CHECK(std::abs(h.b_v - (sampler.at(u, v + e).b - sampler.at(u, v - e).b) / (2 * e)) < 1e-6);
                }
            }
    }

    TEST_CASE("height sampler: c2 is twice continuously differentiable at the knots, catmull-rom once") {
        Image<double> image(16, 1, 1);
        std::mt19937 random(2);
        std::uniform_real_distribution<double> number(0, 1);
        for (int x = 0; x < 16; ++x) image.at(x, 0) = number(random);
        const auto jump = [&](Interpolation interpolation, bool second) {
            const HeightSampler<double> sampler(image, interpolation, {});
            double largest = 0;
            for (int x = 0; x < 16; ++x) {
                const double u = (x + 0.5) / 16, e = 1e-7;
                const auto slope = [&](double at) { return sampler.at(at, 0.5).b_u; };
                const double left = second ? (slope(u - e) - slope(u - 2 * e)) / e : slope(u - e);
                const double right = second ? (slope(u + 2 * e) - slope(u + e)) / e : slope(u + e);
                largest = std::max(largest, std::abs(right - left));
            }
            return largest;
        };
        CHECK(jump(Interpolation::c2, false) < 1e-3);
        CHECK(jump(Interpolation::c2, true) < 0.1);
        CHECK(jump(Interpolation::catmull_rom, false) < 1e-3);
        CHECK(jump(Interpolation::catmull_rom, true) > 10);
    }

    TEST_CASE("height sampler: beyond a clamped border the height stays and the slope across is 0") {
        const HeightSampler<double> sampler(wave_picture(16, 12), Interpolation::c2,
                                            {.wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp});
        CHECK(sampler.at(1.7, 0.4).b == doctest::Approx(sampler.at(1, 0.4).b));
        CHECK(sampler.at(1.7, 0.4).b_u == 0);
        CHECK(sampler.at(-3, 0.4).b == doctest::Approx(sampler.at(0, 0.4).b));
    }

    TEST_CASE("read_height: a tint of one level changes neither slopes, nor levels, nor what is grey") {
        Image<float> grey(64, 64, 1), tinted(64, 64, 3);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                grey.at(x, y) = float(20 + (x * 3 + y) % 200) / 255;
                for (int c = 0; c < 3; ++c) tinted.at(x, y, c) = grey.at(x, y) + (c == 0 ? 1 / 255.0f : 0);
            }
        const std::string grey_path = temporary("bake_height_grey.png"),
                          tinted_path = temporary("bake_height_tinted.png");
        write_image(grey_path, grey, {.depth = Depth::u8});
        write_image(tinted_path, tinted, {.depth = Depth::u8});
        const HeightTexture a = read_height(grey_path), b = read_height(tinted_path);
        CHECK(a.levels == b.levels);
        CHECK(a.step == doctest::Approx(1.0 / 255));
        CHECK(a.step == b.step);
        for (std::size_t i = 0; i < a.values.size(); ++i)
            CHECK(b.values.data()[i] - a.values.data()[i] == doctest::Approx(1 / 765.0).epsilon(1e-3));
        std::filesystem::remove(grey_path);
        std::filesystem::remove(tinted_path);
    }

    TEST_CASE("read_height: mean of the channels gives a third for pure colours, luma its weights, and a missing "
              "channel is refused") {
        Image<float> red(2, 2, 3);
        for (int i = 0; i < 12; ++i) red.data()[i] = i % 3 == 0 ? 1.0f : 0.0f;
        const std::string path = temporary("bake_height_red.png");
        write_image(path, red, {.depth = Depth::u8});
        CHECK(read_height(path).values.at(0, 0) == doctest::Approx(85.0 / 255));
        CHECK(read_height(path, Grey::luma).values.at(0, 0) == doctest::Approx(0.2126));
        CHECK(read_height(path, Grey::g).values.at(0, 0) == 0);
        CHECK_THROWS_AS(read_height(path, Grey::a), Error);
        std::filesystem::remove(path);
    }

    TEST_CASE("box_minify: keeps the mean") {
        Image<float> image(8, 4, 1);
        for (int i = 0; i < 32; ++i) image.data()[i] = float(i);
        const Image<float> small = box_minify(image, 4, 2);
        CHECK(small.width() == 4);
        CHECK(small.height() == 2);
        CHECK(small.at(0, 0) == doctest::Approx((0 + 1 + 8 + 9) / 4.0));
    }

    TEST_CASE(
        "dequantise: stays within a step of the file, keeps its cliffs, and brings 8-bit slopes closer to the truth") {
        const int n = 256;
        HeightTexture height;
        height.values = Image<float>(n, n, 1);
        std::vector<float> truth(std::size_t(n) * n);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const double value = 0.5 + 0.5 * sin(2 * pi * 2 * (x + 0.5) / n) * cos(2 * pi * (y + 0.5) / n);
                truth[std::size_t(y) * n + x] = float(value);
                height.values.at(x, y) = float(std::round(value * 255) / 255);
            }
        height.levels = 256;
        height.step = 1.0 / 255;
        const auto slope_error = [&] {
            double sum = 0;
            for (int y = 0; y < n; ++y)
                for (int x = 1; x + 1 < n; ++x) {
                    const std::size_t i = std::size_t(y) * n + x;
                    const double got = (height.values.data()[i + 1] - height.values.data()[i - 1]) / 2,
                                 want = (truth[i + 1] - truth[i - 1]) / 2;
                    sum += (got - want) * (got - want);
                }
            return std::sqrt(sum / (n * n));
        };
        const double before = slope_error();
        dequantise(height, Wrap::repeat, Wrap::repeat);
        for (std::size_t i = 0; i < truth.size(); ++i)
            CHECK(std::abs(height.values.data()[i] - std::round(truth[i] * 255) / 255) <= 1.0001 / 255);
        CHECK(slope_error() < 0.3 * before);
        MESSAGE("slope error per texel " << before << " before, " << slope_error() << " after");
    }
}

TEST_SUITE("stability") {

    TEST_CASE("height sampler: any finite coordinate is safe on 1 x 1, 1 x N and large ones") {
        for (const auto& [width, height] : {std::pair(1, 1), {1, 7}, {7, 1}, {3, 2}})
            for (const Interpolation interpolation : all_interpolations)
                for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
                    const HeightSampler<double> sampler(wave_picture(width, height), interpolation,
                                                        {.wrap_u = wrap, .wrap_v = wrap});
                    for (const double u : {0.0, 1.0, -0.0, 0.9999999999999999, 1e18, -1e300, 0.5})
                        for (const double v : {0.0, 1.0, -1e18, 1e300}) {
                            const Height<double> h = sampler.at(u, v);
                            CHECK(h.b * 0 + h.b_u * 0 + h.b_v * 0 == 0);
                        }
                }
    }

    TEST_CASE("read_height: NaN and Inf are refused with their count and place, as unsuitable") {
        Image<float> bad(4, 3, 1);
        std::fill_n(bad.data(), 12, 0.5f);
        bad.at(2, 1) = std::numeric_limits<float>::quiet_NaN();
        bad.at(3, 2) = std::numeric_limits<float>::infinity();
        const std::string path = temporary("bake_height_nan.exr");
        write_image(path, bad, {.depth = Depth::float32});
        try {
            read_height(path);
            CHECK(false);
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::unsuitable);
            CHECK(std::string(error.what()).find("2 values") != std::string::npos);
            CHECK(std::string(error.what()).find("(2, 1)") != std::string::npos);
        }
        std::filesystem::remove(path);
    }
}
