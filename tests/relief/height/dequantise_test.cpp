#include "bake/relief/height/dequantise.h"
#include "folders.h"
#include "relief/map/torus_relief.h"
#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>

using namespace bake;
using oracle::TorusRelief;

namespace {

Image<float> plane_map(const HeightTexture& height, double amplitude, const Vec2d& extent, Filter filter) {
    NormalMapOptions options;
    options.width = height.values.width(), options.height = height.values.height();
    options.height_options.amplitude = amplitude;
    return normal_map(HeightField(height, options.height_options, filter, options.width, options.height), extent,
                      options);
}

Vec3d normal_at(const Image<float>& map, int x, int y) {
    return Vec3d(decode_normal({map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)}, false));
}

/// Mean angle in degrees of a map to truth(x, y).
template <class Truth> double mean_error(const Image<float>& map, const Truth& truth) {
    std::vector<double> errors;
    for (int y = 0; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x) errors.push_back(oracle::angle_deg(normal_at(map, x, y), truth(x, y)));
    return oracle::spread(errors).mean;
}

struct Errors {
    double stored, dequantised;
};

/// The torus relief at 1024 texels in 8 bits, on a plane as long and wide as the torus.
Errors waves_error(const TorusRelief& r, Filter filter) {
    const Vec2d extent(2 * pi, 2 * pi * 0.4);
    HeightTexture height = oracle::relief_texture(r, 1024, 8);
    const auto error = [&] {
        return mean_error(plane_map(height, 2 * r.A, extent, filter), [&](int x, int y) {
            const Height<double> h = oracle::relief(r, (x + 0.5) / 1024, 1 - (y + 0.5) / 1024);
            return Vec3d(-h.b_u / extent.x, -h.b_v / extent.y, 1);
        });
    };
    const double stored = error();
    dequantise(height, Wrap::repeat, Wrap::repeat);
    return {stored, error()};
}

/// A fine height stretched to the full range and rounded to 8 bits, against the c2 map of the fine one; amplitude 5 %.
Errors rounded_error(const std::string& path, Filter filter) {
    HeightTexture fine = read_height(path);
    Image<float>& values = fine.values;
    const auto [low, high] = std::minmax_element(values.data(), values.data() + values.size());
    const float from = *low, range = *high - *low;
    HeightTexture coarse;
    coarse.values = Image<float>(values.width(), values.height(), 1);
    coarse.levels = 256, coarse.step = 1.0 / 255;
    for (std::size_t i = 0; i < values.size(); ++i) {
        values.data()[i] = (values.data()[i] - from) / range;
        coarse.values.data()[i] = std::round(values.data()[i] * 255) / 255;
    }
    const Vec2d extent = resolve_extent(0, 0, values.width(), values.height());
    const Image<float> truth = plane_map(fine, 0.05, extent, Filter::c2);
    const auto error = [&] {
        return mean_error(plane_map(coarse, 0.05, extent, filter),
                          [&](int x, int y) { return normal_at(truth, x, y); });
    };
    const double stored = error();
    dequantise(coarse, Wrap::repeat, Wrap::repeat);
    return {stored, error()};
}

void say(const std::string& what, const Errors& e) {
    MESSAGE(what << ": " << e.stored << " deg as stored, " << e.dequantised << " deg dequantised");
}

/// Dequantising the height after rounding it to 8 bits never gives three times the error of the rounded height.
void check_harm(const std::filesystem::path& height) {
    for (const Filter filter : {Filter::sobel, Filter::c2}) {
        const Errors e = rounded_error(height.string(), filter);
        say(height.filename().string() + ", " + std::string(name(filter)), e);
        CHECK(e.dequantised < 3 * e.stored);
    }
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("dequantise: the gentler the relief the more it helps, and on a steep one it does no more than a tenth "
              "of harm") {
        double share = 2;
        for (const TorusRelief& r : {TorusRelief{0.01, 24, 12}, {0.01, 12, 6}, {0.01, 6, 4}, {0.01, 3, 2}})
            for (const Filter filter : {Filter::sobel, Filter::c2}) {
                const Errors e = waves_error(r, filter);
                say(std::to_string(r.k) + " x " + std::to_string(r.m) + " waves, " + std::string(name(filter)), e);
                CHECK(e.dequantised < 1.1 * e.stored);
                if (filter == Filter::c2) continue;
                CHECK(e.dequantised / e.stored < share);
                share = e.dequantised / e.stored;
            }
        CHECK(share < 0.2);
    }
}

TEST_SUITE("stability") {
    TEST_CASE("dequantise: on heights with detail it may do harm, and the page says so") {
        check_harm(test::own_meshes() / "bricks.png");
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("dequantise: on heights of others with detail it may do harm, and the page says so") {
        for (const char* name : {"crater_dat.png", "terrain3d_mountain1.exr", "terrain3d_stones.exr"})
            check_harm(test::shared_data() / "textures/heights" / name);
    }
}
