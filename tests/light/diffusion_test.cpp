#include "bake/light/diffusion.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("oracle") {

    TEST_CASE("diffusion: the profile integrates to its closed form, and to 1 over the plane") {
        for (const float d : {0.01f, 1.f, 30.f}) {
            double sum = 0;
            constexpr int count = 20000;
            const double last = 60 * double(d), step = last / count;
            for (int i = 0; i < count; ++i) {
                const double r = (i + 0.5) * step;
                sum += double(diffusion_profile(d, float(r))) * 2 * pi * r * step;
                if (i % 1000 == 999)
                    CHECK(sum == doctest::Approx(diffusion_within(d, float(r + step / 2))).epsilon(1e-4));
            }
            CHECK(sum == doctest::Approx(1).epsilon(1e-4));
        }
    }

    TEST_CASE("diffusion: distances are distributed by the profile, with the mean 2.5 d") {
        constexpr int count = 1 << 16;
        constexpr float d = 0.7f, bounds[] = {0.05f, 0.3f, 0.7f, 2.f, 5.f};
        int within[5] = {};
        double mean = 0;
        for (int i = 0; i < count; ++i) {
            const float r = sample_diffusion(d, (float(i) + 0.5f) / count);
            mean += double(r) / count;
            for (int k = 0; k < 5; ++k) within[k] += r < bounds[k];
        }
        for (int k = 0; k < 5; ++k)
            CHECK(double(within[k]) / count == doctest::Approx(diffusion_within(d, bounds[k])).epsilon(1e-3));
        CHECK(mean == doctest::Approx(2.5 * double(d)).epsilon(1e-3));
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("diffusion: the length is the mean free path over s(A), for light that enters diffusely") {
        CHECK(diffusion_length(0.8f, 2) == doctest::Approx(2 / 1.1));
        CHECK(diffusion_length(0, 1) == doctest::Approx(1 / (1.9 + 3.5 * 0.64)));
        CHECK(diffusion_length(1, 1) == doctest::Approx(1 / (0.9 + 3.5 * 0.04)));
        CHECK(diffusion_length(0.5f, 0) == 0);
        CHECK(diffusion_length(7, 1) == diffusion_length(1, 1));
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("diffusion: extremes are finite and not negative") {
        for (const float d : {1e-12f, 1e-3f, 1.f, 1e12f}) {
            for (const float u : {0.f, 0.25f, 0.5f, 1 - 0x1p-24f}) {
                const float r = sample_diffusion(d, u);
                CHECK(std::isfinite(r));
                CHECK(r >= 0);
            }
            for (const float r : {1e-6f, 1.f, 1e6f}) {
                CHECK(std::isfinite(diffusion_profile(d, r * d)));
                CHECK(diffusion_within(d, r * d) <= 1);
                CHECK(diffusion_within(d, r * d) >= 0);
            }
        }
    }

} // TEST_SUITE
