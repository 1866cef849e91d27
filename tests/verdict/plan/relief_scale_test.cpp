#include "bake/preview/shape_mesh.h"
#include "bake/verdict/plan/relief_scale.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("edge_texels: of a square in quads of 8 texels, sides of 8 and diagonals of 8 sqrt 2") {
        const auto shape = make_shape(shape_mesh("plane", 4, 4));
        CHECK(edge_texels(*shape, 32, 32) == doctest::Approx(8 * std::sqrt((1 + 1 + 2) / 3.0)));
        CHECK(edge_texels(*shape, 64, 64) == doctest::Approx(2 * edge_texels(*shape, 32, 32)));
        Mesh bare = shape_mesh("plane", 4, 4);
        bare.corner_uv.clear();
        CHECK(edge_texels(*make_shape(std::move(bare), {.derivatives = false}), 32, 32) == 0);
    }
}
