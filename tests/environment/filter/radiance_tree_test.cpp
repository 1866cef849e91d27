#include "bake/environment/filter/radiance_tree.h"
#include "bake/environment/sky/test_sky.h"
#include "environment/skies.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("oracle") {

    TEST_CASE("radiance_tree: first moments are those about the rounded centre that a node stores") {
        // Rounding moves a centre by up to 3e-8, which a first moment about the exact centre would be off by.
        const Cube sky = label_sky(16);
        const RadianceTree tree(sky);
        for (int level = 1; level <= tree.last_level(); ++level)
            for (int face = 0; face < 6; ++face)
                for (int y = 0; y < tree.size(level); ++y)
                    for (int x = 0; x < tree.size(level); ++x) {
                        const SkyNode node = tree.node(level, face, x, y);
                        for (int c = 0; c < 3; ++c) {
                            Vec3d D(0);
                            double flux = 0;
                            for (int k = 0; k < 4; ++k) {
                                const SkyNode part = tree.node(level - 1, face, 2 * x + k % 2, 2 * y + k / 2);
                                D += Vec3d(part.D[c]) + double(part.F[c]) * (Vec3d(part.d) - Vec3d(node.d));
                                flux += double(part.F[c]);
                            }
                            // Half a float's step of D, whose size is at most that of the flux times the radius.
                            CHECK(glm::length(D - Vec3d(node.D[c])) <= 1e-7 * flux * double(node.rho));
                        }
                    }
    }

    TEST_CASE("radiance_tree: the mean is that of the brightest channel, the even level that of each without suns") {
        const int n = 6;
        Cube sky = test::rough_sky(n, 3);
        sky[CubeFace::nx].at(1, 2, 1) = -0.5f;
        sky[CubeFace::py].at(3, 4, 2) = 1e4f;
        const auto mean_of = [&](const auto& value, const auto& counts, int c) {
            double sum = 0, all = 0;
            for (int face = 0; face < 6; ++face)
                for (int y = 0; y < n; ++y)
                    for (int x = 0; x < n; ++x) {
                        const double L = double(sky.faces[face].at(x, y, c)), omega = test::texel_solid_angle(n, x, y);
                        if (counts(L)) sum += omega * value(L), all += omega;
                    }
            return sum / all;
        };
        const RadianceTree tree(sky);
        double brightest = 0;
        for (int c = 0; c < 3; ++c) {
            const double mean = mean_of([](double L) { return std::abs(L); }, [](double) { return true; }, c);
            const double even =
                mean_of([](double L) { return L; }, [&](double L) { return std::abs(L) <= 4 * mean; }, c);
            CHECK(tree.even_level(c) == doctest::Approx(even).epsilon(1e-9));
            brightest = std::max(brightest, mean);
        }
        CHECK(tree.mean() == doctest::Approx(brightest).epsilon(1e-9));
    }
}
