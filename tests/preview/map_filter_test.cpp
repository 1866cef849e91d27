// Occlusion maps, and maps that are clamped or mirrored beyond the unit square, over footprints.
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

std::unique_ptr<Shape> plane_with_uvs(float scale, float shift) {
    Mesh mesh = plane_mesh();
    for (Vec2f& uv : mesh.uvs) uv = scale * uv + shift;
    return make_shape(std::move(mesh));
}

SurfaceMap filtered(Texture texture, MapWrap wrap) {
    texture.mips = colour_mips(*texture);
    return {.texture = std::move(texture), .wrap_u = wrap, .wrap_v = wrap};
}

/// Random grey from 0 to 1, with three equal channels.
Texture noise(int size) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> grey(0, 1);
    return texture(size, size, 3, [&](float, float, float* c) { c[0] = c[1] = c[2] = grey(random); });
}

/// The picture and its mirror images beside and above it, as v up has it.
Texture with_mirror_images(const Image<float>& of) {
    const int n = of.width();
    auto out = std::make_shared<Image<float>>(2 * n, 2 * n, 3);
    for (int y = 0; y < 2 * n; ++y)
        for (int x = 0; x < 2 * n; ++x)
            for (int c = 0; c < 3; ++c)
                out->at(x, y, c) = of.at(x < n ? x : 2 * n - 1 - x, y < n ? n - 1 - y : y - n, c);
    return std::shared_ptr<const Image<float>>(std::move(out));
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("map filter: a mirrored map is a repeated map that holds its mirror images, over every footprint") {
        const Texture picture = noise(8);
        SurfaceMaps mirrored, repeated;
        mirrored.occlusion = filtered(picture, MapWrap::mirror);
        repeated.occlusion = filtered(with_mirror_images(*picture), MapWrap::repeat);
        const auto shape = plane_with_uvs(5, -2), half = plane_with_uvs(2.5f, -1);
        std::mt19937 random(7);
        std::uniform_real_distribution<float> any(-1, 1);
        double worst = 0;
        for (int i = 0; i < 2000; ++i) {
            const float b1 = 0.5f + 0.5f * any(random), b2 = (1 - b1) * (0.5f + 0.5f * any(random));
            const ShapePoint at{std::uint32_t(i % 2), b1, b2};
            const float size = std::exp2(4 * any(random) - 3);
            const Footprint print{size * Vec2f(any(random), any(random)), size * Vec2f(any(random), any(random))};
            const Footprint less{0.5f * print.major, 0.5f * print.minor};
            worst = std::max(worst, std::abs(double(occlusion_at(mirrored, *shape, at, print)) -
                                             double(occlusion_at(repeated, *half, at, less))));
        }
        CHECK(worst < 1e-4);
    }

    TEST_CASE("map filter: a clamped map is its border beyond the unit square, and inside what a repeated one is") {
        const Texture picture = texture(64, 64, 3, [](float u, float, float* c) { c[0] = c[1] = c[2] = u; });
        SurfaceMaps clamped, repeated;
        clamped.occlusion = filtered(picture, MapWrap::clamp), repeated.occlusion = filtered(picture, MapWrap::repeat);
        const Footprint wide{{0.1f, 0}, {0, 0.08f}};
        const auto inside = plane_with_uvs(0.2f, 0.4f), right = plane_with_uvs(1, 3), left = plane_with_uvs(1, -3);
        for (std::uint32_t t = 0; t < 2; ++t) {
            const ShapePoint at{t, 0.3f, 0.4f};
            CHECK(occlusion_at(clamped, *inside, at, wide) ==
                  doctest::Approx(occlusion_at(repeated, *inside, at, wide)).epsilon(1e-5));
            CHECK(occlusion_at(clamped, *right, at, wide) > 0.9f);
            CHECK(occlusion_at(clamped, *left, at, wide) < 0.1f);
        }
    }

    TEST_CASE("map filter: a picture of the scene filters occlusion; without a filter it is at a point") {
        SurfaceMaps maps;
        maps.occlusion.texture = texture(64, 64, 3, [](float u, float v, float* c) {
            c[0] = c[1] = c[2] = (int(64 * u) + int(64 * v)) % 2 ? 1.0f : 0.0f;
        });
        for (const MapWrap wrap : {MapWrap::repeat, MapWrap::clamp, MapWrap::mirror}) {
            maps.occlusion.wrap_u = maps.occlusion.wrap_v = wrap;
            const auto darkest_and_brightest = [&](TextureFilter filter) {
                Material material;
                material.reflectance.ambient = Vec3f(1), material.reflectance.diffuse = Vec3f(0);
                material.maps = std::make_shared<const SurfaceMaps>(maps);
                Scene scene = one_mesh(plane_mesh(), material);
                scene.ambient = Vec3f(1);
                scene.camera.position = Vec3f(0, 0, 40);
                scene.camera.fov_deg = 2.7f;
                scene.settings.width = scene.settings.height = 13, scene.settings.spp = 1;
                scene.settings.filter = filter;
                build(scene);
                const Image<float> image = render(scene, scene.settings);
                const auto [least, most] = std::minmax_element(image.data(), image.data() + image.size());
                return Vec2f(*least, *most);
            };
            const Vec2f mean = darkest_and_brightest(TextureFilter::mips),
                        point = darkest_and_brightest(TextureFilter::off);
            CHECK(mean.x > 0.45f);
            CHECK(mean.y < 0.55f);
            CHECK(point.y - point.x > 0.5f);
        }
    }

} // TEST_SUITE
