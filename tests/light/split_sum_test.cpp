#include "bake/light/split_sum.h"
#include "light/lobes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

TEST_SUITE("oracle") {

    TEST_CASE("split_sum: the parts add up to the directional albedo, at any angle") {
        Lobe covered = lobe(LobeKind::lambert, 0.8f);
        covered.covered = true;
        for (const float roughness : {0.3f, 0.6f, 1.f})
            for (const double view : {5., 50., 80.}) {
                const Bsdf bsdf = sum_of({ggx_lobe(roughness, 0.3f), covered});
                const SplitSum sum = split_sum(bsdf, up, Vec3f(direction(view)));
                REQUIRE(sum.count == 1);
                const double all = double((sum.diffuse + sum.scattered + sum.gloss[0].factor).y);
                CHECK(all == doctest::Approx(albedo(bsdf, direction(view))).epsilon(3e-3));
                CHECK(sum.gloss[0].roughness == roughness);
            }
    }

    TEST_CASE("split_sum: the axis is the mean direction of the lobe at 45 degrees, within 2.5") {
        const Vec3f v(direction(45));
        for (const float roughness : {0.1f, 0.3f, 0.45f, 0.6f}) {
            const Bsdf bsdf = sum_of({ggx_lobe(roughness)});
            Vec3d mean(0);
            constexpr int count = 1 << 14;
            for (int i = 0; i < count; ++i) {
                const BsdfSample s =
                    sample(bsdf, up, v, (float(i) + 0.5f) / count, {mirrored_digits(i, 2), mirrored_digits(i, 3)});
                mean += double(s.factor.y) * Vec3d(s.l);
            }
            // Light that is scattered several times is apart from the lobe; it leaves nearly as from a diffuse surface.
            const SplitSum sum = split_sum(bsdf, up, v);
            mean -= count * double(sum.scattered.y) * (2 / 3.0) * Vec3d(up);
            const double off = glm::dot(glm::normalize(mean), Vec3d(sum.gloss[0].axis));
            CAPTURE(roughness);
            CHECK(std::acos(std::min(1.0, off)) * 180 / pi < 2.5);
        }
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE(
        "split_sum: the lobe of a mirror points where the viewer is mirrored, and mirror and glass have no part") {
        const Vec3f v(direction(60, 30));
        const SplitSum sum =
            split_sum(sum_of({ggx_lobe(0), lobe(LobeKind::mirror), lobe(LobeKind::dielectric)}), up, v);
        CHECK(sum.count == 1);
        CHECK(glm::length(sum.gloss[0].axis - Vec3f(-v.x, -v.y, v.z)) < 1e-6f);
        CHECK(sum.diffuse == Vec3f(0));
    }

    TEST_CASE("split_sum: a lobe of Blinn has the width of ggx with the same peak, and Phong's of Blinn's with four "
              "times n") {
        const SplitSum blinn = split_sum(sum_of({cosine_lobe(LobeKind::normalised_blinn, 48)}), up, up);
        const SplitSum phong = split_sum(sum_of({cosine_lobe(LobeKind::normalised_phong, 12)}), up, up);
        CHECK(blinn.gloss[0].roughness == doctest::Approx(std::sqrt(0.2)));
        CHECK(phong.gloss[0].roughness == blinn.gloss[0].roughness);
    }

} // TEST_SUITE
