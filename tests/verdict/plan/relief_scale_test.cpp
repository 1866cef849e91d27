#include "bake/preview/shape_mesh.h"
#include "bake/verdict/plan/relief_scale.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("dominant_wave: a sine has its own wavelength, a flat height an infinite one") {
        Image<float> height(64, 16, 1);
        for (const int waves : {1, 4, 16}) {
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 64; ++x) height.at(x, y) = float(3 + std::sin(2 * pi * waves * (x + 0.3) / 64));
            CHECK(dominant_wave(height) == doctest::Approx(64.0 / waves).epsilon(1e-4));
        }
        for (std::size_t i = 0; i < height.size(); ++i) height.data()[i] = 0.7f;
        CHECK(std::isinf(dominant_wave(height)));
    }

    TEST_CASE("edge_texels: of a square in quads of 8 texels, sides of 8 and diagonals of 8 sqrt 2") {
        const auto shape = make_shape(shape_mesh("plane", 4, 4));
        CHECK(edge_texels(*shape, 32, 32) == doctest::Approx(8 * std::sqrt((1 + 1 + 2) / 3.0)));
        CHECK(edge_texels(*shape, 64, 64) == doctest::Approx(2 * edge_texels(*shape, 32, 32)));
        Mesh bare = shape_mesh("plane", 4, 4);
        bare.corner_uv.clear();
        CHECK(edge_texels(*make_shape(std::move(bare), {.derivatives = false}), 32, 32) == 0);
    }
}
