#include "bake/environment/filter/interpolated.h"
#include "environment/between.h"
#include "environment/skies.h"
#include "oracle/zonal.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("oracle") {
    TEST_CASE("interpolated_best: what is looked up between the texels is more than twice as near to the function") {
        const Vec3d ahead = glm::normalize(Vec3d(0.35, 0.45, 0.82));
        for (const auto& [n, kappa] : {std::pair(8, 3.0), {16, 10.0}, {64, 100.0}, {128, 600.0}}) {
            const oracle::Sun sun{.amplitude = 5, .kappa = kappa};
            const auto light = [&](const Vec3d& d) { return 0.2 + sun.radiance(glm::dot(d, ahead)); };
            const Cube samples = test::sky_of(n, 1, [&](const Vec3d& d, int) { return light(d); });
            const test::Between plain = test::between(samples, 0, light),
                                best = test::between(interpolated_best(samples), 0, light);
            MESSAGE(n << " texels: rms " << plain.rms << " of samples, " << best.rms
                      << " of what is interpolated best");
            CHECK(best.rms < 0.5 * plain.rms);
            CHECK(best.most < plain.most);
        }
    }
}

TEST_SUITE("unit") {
    TEST_CASE("interpolated_best: an even sky stays as it is, and each channel is by itself") {
        const Cube even = interpolated_best(test::even_sky(4, 3, 0.7));
        for (const Image<float>& face : even.faces)
            for (std::size_t i = 0; i < face.size(); ++i) CHECK(face.data()[i] == doctest::Approx(0.7f).epsilon(1e-6));
        const Cube two = test::rough_sky(8, 2), best = interpolated_best(two);
        Cube one = make_cube(8, 1);
        test::for_each_texel(two,
                             [&](int face, int x, int y, const float* value) { one.faces[face].at(x, y) = value[1]; });
        const Cube alone = interpolated_best(one);
        test::for_each_texel(
            best, [&](int face, int x, int y, const float* value) { CHECK(value[1] == alone.faces[face].at(x, y)); });
    }

    TEST_CASE("interpolated_best: no value below its half beside a light, and any size of face") {
        for (const auto& [n, dark] : {std::pair(1, 0.5f), {2, 0.5f}, {16, 0.5f}, {16, 0.0f}}) {
            Cube sky = test::even_sky(n, 1, dark);
            sky.faces[2].at(n / 2, n / 2) = 1e5f;
            const Cube best = interpolated_best(sky);
            test::for_each_texel(best,
                                 [least = dark / 2](int, int, int, const float* value) { CHECK(value[0] >= least); });
            CHECK(best.faces[2].at(n / 2, n / 2) > 1e5f);
        }
    }
}
