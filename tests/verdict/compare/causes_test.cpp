// The shares of the error by cause, in scenes where all but one cause are known to be absent.
#include "bake/base/parallel.h"
#include "bake/preview/shape_mesh.h"
#include "bake/verdict/compare/causes.h"
#include "folders.h"
#include "verdict/compare/relief_pair.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

Texture stripes(int count) {
    return texture(64, 64, 3, [=](float u, float, float* rgb) {
        rgb[0] = rgb[1] = rgb[2] = int(u * float(count)) % 2 ? 1 : 0.2f;
    });
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("causes: without height every share is 0") {
        // On the sphere a displaced mesh interpolates normals over smaller facets.
        for (const auto& [mesh, most] : {std::pair(plane_mesh(3), 1e-12), std::pair(shape_mesh("cube:a=1.5"), 1e-9),
                                         std::pair(sphere_mesh(32, 16), 1e-6)}) {
            const ReliefPair pair(mesh, {}, eggs(0, 1), "exact", "displace:4", [](Scene& scene) {
                scene.lights = {directional(Vec3f(1, 2, 3))};
                scene.camera.position = Vec3f(1, 1.5f, 4);
            });
            const CauseShares shares = pair.shares(small_picture());
            REQUIRE(shares.pixels > 100);
            CHECK(std::abs(shares.total) < most);
            for (const double share : shares.shares()) CHECK(std::abs(share) < most);
        }
    }

    TEST_CASE("causes: at normal incidence and without shadows bump is displacement") {
        const ReliefPair pair(plane_mesh(2), {}, eggs(0.05, 2), "exact", "displace:64",
                              from_above(Vec3f(2, 1, 2), false));
        const CauseShares shares = pair.shares(small_picture());
        CHECK(shares.pixels == 32 * 32);
        CHECK(std::abs(shares.total) < 1e-5); // of radiance around 0.6; facets of 1/64 remain
        CHECK(shares.silhouette == 0);
    }

    TEST_CASE("causes: under a low sun the same plane lacks its own shadows") {
        const ReliefPair pair(plane_mesh(2), {}, eggs(0.1, 2), "exact", "displace:64", from_above(Vec3f(6, 1, 1.5f)));
        const CauseShares shares = pair.shares(small_picture());
        CHECK(shares.total > 0.005);
        CHECK(share_of(shares, Cause::self_shadow) > 0.95);
    }

    TEST_CASE("causes: a constant offset moves nothing under the sun, and under a lamp its points come nearer") {
        const HeightTexture offset = height_of(8, [](double, double) { return 0.3; });
        const ReliefPair sunny(plane_mesh(2), {}, offset, "exact", "displace:2", from_above(Vec3f(1, 2, 3)));
        CHECK(std::abs(sunny.shares(small_picture()).total) < 1e-12);

        const auto lamp = [](Scene& scene) {
            from_above(Vec3f(0, 0, 1))(scene);
            scene.lights[0].kind = LightKind::point;
            scene.lights[0].position = Vec3f(0, 0, 2);
            scene.lights[0].falloff = {0, 0, 1};
        };
        const ReliefPair lit(plane_mesh(2), {}, offset, "exact", "displace:2", lamp);
        const CauseShares shares = lit.shares(small_picture());
        CHECK(shares.total > 1e-3);
        CHECK(share_of(shares, Cause::parallax) == doctest::Approx(1).epsilon(1e-6));
    }

    TEST_CASE("causes: what glows alike everywhere differs by its silhouette alone") {
        Material glow;
        glow.reflectance.emission = Vec3f(0.5f);
        glow.reflectance.diffuse = Vec3f(0);
        const ReliefPair pair(sphere_mesh(24, 12), glow, eggs(0.25, 3), "bump", "displace:8", [](Scene&) {});
        const CauseOptions options = small_picture(32, 8);
        const CauseShares shares = pair.shares(options);
        CHECK(shares.total > 1e-3);
        CHECK(share_of(shares, Cause::silhouette) == doctest::Approx(1).epsilon(1e-9));
        CHECK(shares.total / picture_error(pair, options, shares.pixels) == doctest::Approx(1).epsilon(1e-5));
        CHECK(std::abs(shares.interaction) < 1e-12);
    }

    TEST_CASE("causes: a plane that fills the picture and is raised has parallax alone") {
        Material striped;
        striped.albedo = stripes(8);
        striped.reflectance.ambient = Vec3f(1), striped.reflectance.diffuse = Vec3f(0);
        const auto near = [](Scene& scene) {
            scene.ambient = Vec3f(1);
            scene.camera.position = Vec3f(0, 0, 2);
        };
        const HeightTexture offset = height_of(8, [](double, double) { return 0.3; });
        const ReliefPair pair(plane_mesh(2), striped, offset, "exact", "displace:2", near);
        const CauseOptions options = small_picture();
        const CauseShares shares = pair.shares(options);
        CHECK(shares.total > 0.01);
        CHECK(share_of(shares, Cause::parallax) == doctest::Approx(1).epsilon(1e-6));
        CHECK(shares.total / picture_error(pair, options, shares.pixels) == doctest::Approx(1).epsilon(1e-4));
    }

    TEST_CASE("causes: the same displaced mesh with another normal differs by its normal alone") {
        ReliefPair pair(plane_mesh(2), {}, eggs(0.1, 2), "displace:8", "displace:8", [](Scene& scene) {
            scene.camera.position = Vec3f(1, 0, 3);
            scene.lights = {directional(Vec3f(1, 2, 3))};
        });
        Material& wrong = *pair.method.materials[0];
        wrong.object_normals = texture(2, 2, 3, [](float, float, float* n) { n[0] = 0.5f, n[1] = 0, n[2] = 0.8f; });
        const CauseOptions options = small_picture();
        const CauseShares shares = pair.shares(options);
        CHECK(shares.total > 0.005);
        CHECK(share_of(shares, Cause::normal) == doctest::Approx(1).epsilon(1e-6));
        CHECK(shares.total / picture_error(pair, options, shares.pixels) == doctest::Approx(1).epsilon(1e-4));
    }

    TEST_CASE("causes: the same displaced mesh with filtered textures differs by its filter alone") {
        Material fine;
        fine.albedo = stripes(64);
        ReliefPair pair(plane_mesh(2), fine, eggs(0.1, 2), "displace:8", "displace:8", [](Scene& scene) {
            scene.lights = {directional(Vec3f(1, 2, 3))};
            scene.camera.position = Vec3f(0, -3, 1.5f);
        });
        pair.method.settings.filter = TextureFilter::moments;
        build(pair.method);
        const CauseShares shares = pair.shares(small_picture(48, 2));
        CHECK(shares.total > 1e-4);
        CHECK(share_of(shares, Cause::filtering) == doctest::Approx(1).epsilon(1e-6));
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("causes: Shapley values of games with known ones") {
        std::array<double, 1u << cause_count> additive{}, both{}, random{};
        std::mt19937 numbers(7);
        std::uniform_real_distribution<double> uniform(-1, 1);
        for (CauseSet on = 0; on <= all_causes; ++on) {
            for (int i = 0; i < cause_count; ++i) additive[on] += (on >> i & 1) * (i + 1.0);
            both[on] = (on & 0b10010) == 0b10010 ? 6 : 0; // two causes that only act together
            random[on] = on ? uniform(numbers) : 0;
        }
        const auto each = shapley_values(additive), pair = shapley_values(both), any = shapley_values(random);
        double all = 0;
        for (std::size_t i = 0; i < cause_count; ++i) {
            CHECK(each[i] == doctest::Approx(double(i) + 1).epsilon(1e-12));
            CHECK(pair[i] == doctest::Approx(i == 1 || i == 4 ? 3 : 0).epsilon(1e-12));
            all += any[i];
        }
        CHECK(all == doctest::Approx(random[all_causes]).epsilon(1e-12));
    }

    TEST_CASE("causes: one thread and many give the same numbers; a stride and an exposure the same shares") {
        const ReliefPair pair(sphere_mesh(24, 12), {}, eggs(0.15, 3), "bump", "displace:8",
                              [](Scene& scene) { scene.lights = {directional(Vec3f(3, 1, 1))}; });
        CauseOptions options = small_picture(64, 2);
        const CauseShares many = pair.shares(options);
        options.exposure = 1;
        const CauseShares brighter = pair.shares(options);
        options.stride = 2;
        const CauseShares part = pair.shares(options);
        options.exposure = 0, options.stride = 1;
        const ThreadLimit one(1);
        const CauseShares single = pair.shares(options);
        CHECK(single.shares() == many.shares());
        CHECK(brighter.total / many.total == doctest::Approx(4).epsilon(1e-9));
        CHECK(double(part.pixels) == doctest::Approx(0.25 * double(many.pixels)).epsilon(0.1));
        CHECK(part.total / brighter.total == doctest::Approx(1).epsilon(0.1));
    }

    TEST_CASE("causes: loaded scenes of a smooth shape, with a method that displaces itself") {
        SceneEntries entries;
        entries.settings = small_picture(24, 2).settings;
        entries.settings.filter = TextureFilter::off;
        entries.cameras.emplace_back().position = Vec3f(0, 1, 4);
        entries.lights = {directional(Vec3f(2, 1, 1))}, entries.any_light = true;
        entries.ground.emplace().height = -1.5f;
        MaterialEntry& bricks = entries.materials.emplace_back();
        bricks.relief.file = (own_meshes() / "bricks.png").string();
        bricks.relief.amplitude = 0.2f;
        MeshEntry& sphere = entries.meshes.emplace_back();
        sphere.shape = "sphere:R=1", sphere.columns = 24, sphere.rows = 12, sphere.material = 0;
        const auto loaded = [&](const char* word, bool flat) {
            bricks.relief.shade = parse_shade(word);
            return load(flat ? without_heights(entries) : entries);
        };
        const Scene reference = loaded("displace:8", false), reference_base = loaded("displace:8", true);
        const Scene coarse = loaded("displace:2", false), coarse_base = loaded("displace:2", true);
        const Scene bump = loaded("bump", false);
        const CauseOptions options{.settings = entries.settings};
        const CauseShares of_bump = cause_shares({&bump, &reference, nullptr, &reference_base, {0}}, options);
        const CauseShares of_coarse = cause_shares({&coarse, &reference, &coarse_base, &reference_base, {0}}, options);
        for (const CauseShares* shares : {&of_bump, &of_coarse}) {
            CHECK(shares->total > 1e-4);
            CHECK(sum(*shares) == doctest::Approx(shares->total).epsilon(1e-12));
        }
        CHECK(of_coarse.total < of_bump.total);
        CHECK(share_of(of_bump, Cause::silhouette) > 0.2);
        CHECK(of_coarse.silhouette < 0.5 * of_bump.silhouette);
    }

    TEST_CASE("causes: a picture without the object has no error") {
        const ReliefPair pair(plane_mesh(), {}, eggs(0.1, 1), "bump", "displace:2",
                              [](Scene& scene) { scene.camera.target = Vec3f(0, 0, 9); });
        const CauseShares shares = pair.shares(small_picture(8));
        CHECK(shares.pixels == 0);
        CHECK(shares.total == 0);
        CHECK(std::string(name(Cause::self_shadow)) == "self-shadow");
    }

} // TEST_SUITE
