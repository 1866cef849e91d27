// The pictures between a method and the reference.
#include "verdict/compare/relief_pair.h"
#include <doctest/doctest.h>
#include <map>

using namespace bake;
using namespace bake::test;

TEST_SUITE("oracle") {

    TEST_CASE("hybrids: mirror rays start on the surface of the scene that they see") {
        Material mirror;
        mirror.reflectance.diffuse = Vec3f(0), mirror.reflect = Vec3f(0.5f);
        const HeightTexture dent = height_of(8, [](double, double) { return -0.3; });
        const ReliefPair pair(plane_mesh(2), mirror, dent, "exact", "displace:2", [](Scene& scene) {
            from_above(Vec3f(0, 0, 1))(scene);
            scene.sky.cube = constant_cube(Vec3f(0.5f));
        });
        const CauseShares shares = pair.shares(small_picture(8));
        REQUIRE(shares.pixels == 64);
        CHECK(std::abs(shares.total) < 1e-12);
        for (const double alone : shares.alone) CHECK(std::abs(alone) < 1e-12);
    }

    TEST_CASE("hybrids: a highlight that is widened in place of slopes is shared by normal and filtering") {
        Material shiny;
        shiny.reflectance.specular = Vec3f(0.5f), shiny.reflectance.shininess = 60;
        ReliefPair pair(plane_mesh(2), shiny, eggs(0.02, 2), "displace:8", "displace:8",
                        from_above(Vec3f(0.2f, 0.1f, 1)));
        pair.method.materials[0]->reflectance.shininess = 10;
        const CauseShares shares = pair.shares(small_picture());
        CHECK(shares.total > 1e-4);
        CHECK(share_of(shares, Cause::normal) == doctest::Approx(0.5).epsilon(1e-6));
        CHECK(share_of(shares, Cause::filtering) == doctest::Approx(0.5).epsilon(1e-6));
    }

    TEST_CASE("hybrids: slopes that are averaged are the normal's error as much as the filter's") {
        ReliefPair pair(plane_mesh(2), {}, eggs(0.02, 20), "bump", "bump", [](Scene& scene) {
            scene.lights = {directional(Vec3f(1, 2, 1))};
            scene.camera.position = Vec3f(0, -3, 1.5f);
        });
        pair.method.settings.filter = TextureFilter::mips;
        build(pair.method);
        const CauseShares shares = pair.shares(small_picture(32, 2));
        CHECK(shares.total > 1e-4);
        CHECK(shares.alone[std::size_t(Cause::filtering)] / shares.total == doctest::Approx(1).epsilon(1e-6));
        CHECK(share_of(shares, Cause::filtering) == doctest::Approx(0.5).epsilon(1e-6));
        CHECK(share_of(shares, Cause::normal) == doctest::Approx(0.5).epsilon(1e-6));
    }

    TEST_CASE("hybrids: displaced normals that face away from the viewer are those of the exact method") {
        const ReliefPair pair(plane_mesh(2), {}, eggs(0.1, 2), "exact", "displace:64", [](Scene& scene) {
            scene.camera.position = Vec3f(0, -4, 0.6f);
            scene.lights = {directional(Vec3f(1, 1, 1))};
            scene.settings.shadows = false;
        });
        const CauseShares shares = pair.shares(small_picture());
        CHECK(shares.total > 0.01);
        CHECK(shares.alone[std::size_t(Cause::normal)] < 1e-3 * shares.total);
    }

    TEST_CASE("hybrids: far from 0, where each scene has an origin of its own, the shares are those near 0") {
        const HeightTexture lopsided =
            height_of(64, [](double u, double v) { return 0.3 * std::max(0.0, std::sin(2 * pi * u)) * (1 - v); });
        const auto at = [&](float x) {
            return ReliefPair(sphere_mesh(24, 12), {}, lopsided, "bump", "displace:8", [=](Scene& scene) {
                scene.instances[0].translate.x = x;
                scene.camera.position = Vec3f(x, 1, 4), scene.camera.target = Vec3f(x, 0, 0);
                scene.lights = {directional(Vec3f(2, 1, 1))};
                scene.lights[0].kind = LightKind::point, scene.lights[0].position = Vec3f(x + 1.5f, 0.5f, 1);
                scene.lights[0].falloff = {0, 0, 1};
            });
        };
        const ReliefPair near = at(0), far = at(4096);
        REQUIRE(far.method.origin != far.reference.origin);
        const CauseShares expected = near.shares(small_picture()), found = far.shares(small_picture());
        CHECK(expected.total > 1e-3);
        for (std::size_t i = 0; i < cause_count; ++i)
            CHECK(std::abs(found.alone[i] - expected.alone[i]) < 0.003 * expected.total);
        CHECK(found.total / expected.total == doctest::Approx(1).epsilon(0.02));
    }

    TEST_CASE("hybrids: those with all and with no causes are the pictures of the reference and of the method") {
        Material shiny;
        shiny.reflectance.specular = Vec3f(0.4f), shiny.reflectance.shininess = 40;
        shiny.reflect = Vec3f(0.2f);
        const ReliefPair pair(sphere_mesh(24, 12), shiny, eggs(0.15, 3), "bump", "displace:8", [](Scene& scene) {
            scene.lights = {directional(Vec3f(1, 2, 3))};
            scene.sky.cube = constant_cube(Vec3f(0.3f, 0.4f, 0.5f));
        });
        const RenderSettings settings = small_picture(24, 4).settings;
        const HybridTracer tracer(pair.scenes(), settings);
        const auto mean_difference = [&](const Scene& scene, CauseSet on) {
            const Image<float> hybrid = render_hybrid(tracer, settings, on);
            const Halves halves = render_halves(scene, settings);
            double sum = 0;
            for (std::size_t i = 0; i < hybrid.size(); ++i)
                sum += std::abs(hybrid.data()[i] - 0.5 * (double(halves.a.data()[i]) + halves.b.data()[i]));
            return sum / double(hybrid.size());
        };
        // Packets may decide between equally near triangles otherwise than single rays.
        CHECK(mean_difference(pair.method, 0) < 1e-5);
        CHECK(mean_difference(pair.reference, all_causes) < 1e-5);
        CHECK(mean_difference(pair.reference, 0) > 0.01);
        const CauseShares shares = pair.shares({.settings = settings});
        CHECK(shares.total / picture_error(pair, {.settings = settings}, shares.pixels) ==
              doctest::Approx(1).epsilon(1e-3));
        CHECK(sum(shares) == doctest::Approx(shares.total).epsilon(1e-12));
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("hybrids: groups have one pixel of every square of the stride, and none beyond the picture") {
        const RenderSettings settings = [] {
            RenderSettings odd;
            odd.width = 21, odd.height = 14;
            return odd;
        }();
        for (const int stride : {1, 2, 3}) {
            std::map<std::pair<int, int>, int> in_square;
            for (int y = 0; y * stride < settings.height; y += block_edge)
                for (int x = 0; x * stride < settings.width; x += block_edge) {
                    const PixelGroup group = pixel_group(settings, x, y, stride);
                    for (std::size_t lane = 0; lane < packet_size; ++lane) {
                        const int column = group.x[lane], row = group.y[lane];
                        CHECK((group.inside >> lane & 1) == (column < settings.width && row < settings.height));
                        ++in_square[{column / stride, row / stride}];
                    }
                }
            for (const auto& square : in_square) CHECK(square.second == 1);
            CHECK(int(in_square.size()) * stride * stride >= settings.width * settings.height);
        }
    }

} // TEST_SUITE
