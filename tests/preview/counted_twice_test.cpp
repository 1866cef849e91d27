#include "bake/preview/counted_twice.h"
#include "bake/preview/relief_method.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

HeightTexture bumps(int size, int k) {
    HeightTexture height;
    height.values = Image<float>(size, size, 1);
    height.info.type = SampleType::float32;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            height.values.at(x, y) =
                float(std::sin(2 * pi * k * (x + 0.5) / size) * std::sin(2 * pi * k * (y + 0.5) / size));
    return height;
}

ReliefModel model(const std::string& word, const Shape& shape, const HeightTexture& height) {
    return with_relief(Material{}, shape, height,
                       {.method = parse_shade(word).value(), .height = {.amplitude = 0.03, .midlevel = 0}});
}

CommonRelief common(const Material& material, Shape& shape) {
    if (material.normal_map) add_tangents(shape);
    if (material.height || material.bump_table) add_derivatives(shape.surface);
    return common_relief(material, shape);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("counted_twice: a map on the mesh that its height displaced is noticed, other maps and meshes are not") {
        const auto ball = make_shape(sphere_mesh(64, 32));
        const HeightTexture height = bumps(256, 8), other = bumps(256, 11);
        ReliefModel displaced = model("displace:4", *ball, height);
        for (const char* word : {"normal", "bump", "exact"}) {
            const Material same = model(word, *ball, height).material, different = model(word, *ball, other).material;
            const CommonRelief twice = common(same, *displaced.shape);
            const CommonRelief apart = common(different, *displaced.shape), none = common(same, *ball);
            MESSAGE(word << ": correlation " << twice.correlation << ", share " << twice.share << "; of another relief "
                         << apart.correlation << ", of the mesh without " << none.correlation);
            CHECK(counted_twice(twice));
            CHECK(twice.correlation > 0.6);
            CHECK(std::abs(apart.correlation) < 0.2);
            CHECK(std::abs(none.correlation) < 0.2);
        }
        // What a map holds that was baked for the displaced mesh is what the mesh lacks.
        ReliefModel residual = model("displace+normal:4", *ball, height);
        CHECK_FALSE(counted_twice(common(residual.material, *residual.shape)));
        const auto flat = make_shape(plane_mesh());
        CHECK_FALSE(counted_twice(common(model("bump", *flat, height).material, *flat)));
    }

} // TEST_SUITE
