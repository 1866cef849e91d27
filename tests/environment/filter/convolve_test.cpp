#include "bake/base/vec.h"
#include "bake/environment/filter/convolve.h"
#include "environment/skies.h"
#include "oracle/zonal.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// A sky's texels as sources, for the double loop that is the yardstick.
struct Source {
    Vec3d d;
    double omega;
    const float* radiance;
};
std::vector<Source> sources_of(const Cube& sky) {
    std::vector<Source> sources;
    test::for_each_texel(sky, [&](int face, int x, int y, const float* value) {
        sources.push_back(
            {test::texel_direction(sky.size(), face, x, y), test::texel_solid_angle(sky.size(), x, y), value});
    });
    return sources;
}

struct Spread {
    double rms = 0, most = 0;
};
/// Errors of every `stride`th texel of `out`, over the sky's mean, against the sum over all texels of the sky.
template <class Kernel> Spread errors(const Cube& out, const Cube& sky, Kernel&& kernel, int stride = 1) {
    const std::vector<Source> sources = sources_of(sky);
    const int channels = sky.faces[0].channels();
    double mean = 0, squares = 0;
    for (const Source& s : sources)
        for (int c = 0; c < channels; ++c) mean += s.omega * double(s.radiance[c]) / (4 * pi * channels);
    Spread spread;
    int count = 0, texel = 0;
    test::for_each_texel(out, [&](int face, int x, int y, const float* value) {
        if (texel++ % stride != 0) return;
        const Vec3d n = test::texel_direction(out.size(), face, x, y);
        double white = 0, light[4] = {};
        for (const Source& s : sources) {
            const double weight = s.omega * kernel(glm::dot(n, s.d));
            white += weight;
            for (int c = 0; c < channels; ++c) light[c] += weight * double(s.radiance[c]);
        }
        for (int c = 0; c < channels; ++c) {
            const double error = std::abs(double(value[c]) - light[c] / white) / mean;
            squares += error * error, ++count, spread.most = std::max(spread.most, error);
        }
    });
    spread.rms = std::sqrt(squares / count);
    return spread;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("lobe: kernels are the papers' up to a constant, with their derivatives and integrals") {
        const auto check = [](const auto& lobe, const auto& kernel) {
            const double scale = double(lobe.at(0.0f)) / kernel(1.0);
            for (const double c : {1.0, 0.9999, 0.99, 0.7, 0.3, 0.01, 0.0, -0.4})
                CHECK(double(lobe.at(float(1 - c))) == doctest::Approx(scale * kernel(c)).epsilon(1e-4).scale(1e-5));
            // Above the horizon by more than r, the spread does not matter. K, K' and K'' by differences of the oracle.
            for (const double c : {0.99, 0.8, 0.4}) {
                const double step = 1e-4;
                const LobeValue value = lobe.at(float(1 - c), 0.05f);
                const double K = scale * kernel(c), up = scale * kernel(c + step), down = scale * kernel(c - step);
                CHECK(double(value.K) == doctest::Approx(K).epsilon(1e-4));
                CHECK(double(value.K1) == doctest::Approx((up - down) / (2 * step)).epsilon(1e-3).scale(K + 1e-9));
                CHECK(double(value.K2) ==
                      doctest::Approx((up - 2 * K + down) / (step * step)).epsilon(1e-2).scale(K + 1e-9));
            }
            const double integral = 2 * pi * scale * oracle::integral_towards(0, 1, 40, kernel);
            CHECK(lobe.integral() == doctest::Approx(integral).epsilon(1e-6));
        };
        for (const double alpha : {0.02, 0.1, 0.5, 0.999, 1.0})
            check(GgxLobe::of_alpha(alpha), [=](double c) { return oracle::ggx_kernel(c, alpha); });
        for (const double exponent : {1.0, 2.0, 7.5, 200.0})
            check(PhongLobe{float(exponent)}, [=](double c) { return oracle::phong_kernel(c, exponent); });
    }

    TEST_CASE("lobe: powers of the cosine are std::pow's") {
        double worst = 0;
        for (const double n : {0.0, 0.3, 1.0, 2.5, 40.0, 1e4, 1e6})
            for (double t = 1e-9; t < 0.9999; t *= 1.07) {
                const double expected = std::exp(n * std::log1p(-double(float(t)))),
                             exponent = std::abs(n * std::log1p(-t));
                if (exponent > 80) continue;
                worst = std::max(worst,
                                 std::abs(double(power_of_cosine(float(t), float(n))) / expected - 1) / (1 + exponent));
            }
        CHECK(worst < 5e-7);
        CHECK(power_of_cosine(0, 1e6f) == 1);
        CHECK(power_of_cosine(1, 0) == 0);
        CHECK(power_of_cosine(1.5f, 3) == 0);
        CHECK(power_of_cosine(0.999f, 1e6f) == 0);
    }

    TEST_CASE("lobe: a source across the horizon is let in by its part above it") {
        for (const double c : {-0.3, -0.1, 0.0, 0.07, 0.2}) {
            const double r = 0.2;
            double mean = 0, slope = 0;
            for (int i = 0; i < 10000; ++i) {
                const double at = c - r + 2 * r * (i + 0.5) / 10000;
                mean += std::max(at, 0.0) / 10000, slope += (at > 0) / 10000.0;
            }
            CHECK(double(above_horizon(float(c), float(r)).K) == doctest::Approx(mean).epsilon(1e-4).scale(1e-5));
            CHECK(double(above_horizon(float(c), float(r)).K1) == doctest::Approx(slope).epsilon(1e-3).scale(1e-4));
        }
    }

    TEST_CASE("radiance_tree: a node's moments are those of the texels below it") {
        for (const int n : {8, 11}) {
            const Cube sky = test::rough_sky(n, 3);
            const RadianceTree tree(sky);
            CHECK(tree.size(tree.last_level()) == 1);
            for (int level = 1; level <= tree.last_level(); ++level)
                for (int face = 0; face < 6; ++face) {
                    const int x = tree.size(level) - 1, y = tree.size(level) / 2, width = 1 << level;
                    const SkyNode node = tree.node(level, face, x, y);
                    double omega = 0, F = 0;
                    Vec3d d(0.0), first(0.0);
                    for (int j = y * width; j < std::min(n, (y + 1) * width); ++j)
                        for (int i = x * width; i < std::min(n, (x + 1) * width); ++i) {
                            const double area = test::texel_solid_angle(n, i, j);
                            const Vec3d at = test::texel_direction(n, face, i, j);
                            omega += area, d += area * at;
                            F += area * double(sky.faces[face].at(i, j, 2)),
                                first += area * double(sky.faces[face].at(i, j, 2)) * at;
                        }
                    d /= omega;
                    CHECK(double(node.omega) == doctest::Approx(omega).epsilon(1e-6));
                    CHECK(glm::length(Vec3d(node.d) - d) < 1e-6);
                    CHECK(double(node.h) == doctest::Approx((1 - glm::dot(d, d)) / 2).epsilon(1e-5));
                    CHECK(double(node.F[2]) == doctest::Approx(F).epsilon(1e-6));
                    CHECK(glm::length(Vec3d(node.D[2]) - (first - F * d)) < 1e-6 * F);
                    CHECK(double(node.rho) < 1.1);
                }
            double flux = 0;
            for (int face = 0; face < 6; ++face) flux += double(tree.node(tree.last_level(), face, 0, 0).F[1]);
            CHECK(flux == doctest::Approx(test::flux(sky, 1)).epsilon(1e-6));
        }
    }

    TEST_CASE("convolve: on rough skies it is the sum over all texels to 5e-4 of the mean") {
        const Cube sky = test::rough_sky(48, 3);
        const RadianceTree tree(sky);
        for (const double alpha : {0.05, 0.2, 0.5, 1.0}) {
            const Spread e = errors(
                convolve(tree, GgxLobe::of_alpha(alpha), 16), sky,
                [=](double c) { return oracle::ggx_kernel(c, alpha); }, 11);
            MESSAGE("ggx " << alpha << ": rms " << e.rms << ", largest " << e.most);
            CHECK(e.rms < 5e-4);
            CHECK(e.most < 3e-3);
        }
        for (const double exponent : {1.0, 20.0, 150.0}) {
            const Spread e = errors(
                convolve(tree, PhongLobe{float(exponent)}, 16), sky,
                [=](double c) { return oracle::phong_kernel(c, exponent); }, 11);
            MESSAGE("phong " << exponent << ": rms " << e.rms << ", largest " << e.most);
            CHECK(e.rms < 5e-4);
            CHECK(e.most < 3e-3);
        }
    }

    TEST_CASE("convolve: smaller nodes and tolerance lead to the exact sum") {
        const Cube sky = test::rough_sky(32, 1);
        const RadianceTree tree(sky);
        const auto error = [&](float node_width, float tolerance) {
            return errors(convolve(tree, GgxLobe::of_alpha(0.3), 8, {node_width, tolerance}), sky,
                          [](double c) { return oracle::ggx_kernel(c, 0.3); })
                .rms;
        };
        const double coarse = error(1, 1e-2f), usual = error(0.5f, 1e-4f), all = error(0, 0);
        MESSAGE("coarse " << coarse << ", usual " << usual << ", every texel " << all);
        CHECK(coarse > 5 * usual);
        CHECK(usual > 1.2 * all);
        // Every texel by itself: the oracle has the white sum of texels below it, where convolve has the lobe's integral; the
        // two differ by the texels that the horizon cuts.
        CHECK(all < 1e-4);
    }

    TEST_CASE("convolve: a tree without its finest levels is as good for wide lobes, at a fraction of the memory") {
        CHECK(finest_level_for(512, 2) == 0);
        CHECK(finest_level_for(2048, 2) == 2);
        CHECK(finest_level_for(2048, 0.02f) == 1);
        CHECK(finest_level_for(2048, 0.001f) == 0);
        const Cube sky = test::rough_sky(44, 2);
        const RadianceTree whole(sky), pruned(sky, 2);
        const SkyNode a = whole.node(1, 3, 9, 20), b = pruned.node(1, 3, 9, 20);
        CHECK(a.Q == b.Q);
        CHECK(a.F[1] == b.F[1]);
        const GgxLobe lobe = GgxLobe::of_alpha(0.7);
        // What it leaves out is a node's own unevenness, 11 nodes to an edge and 1.5 decades of noise.
        CHECK(test::largest_difference(convolve(whole, lobe, 12), convolve(pruned, lobe, 12)) < 0.03 * whole.mean());
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("convolve: a lobe narrower than any texel gives the texel itself") {
        const Cube sky = test::rough_sky(8, 2);
        const RadianceTree tree(sky);
        CHECK(test::largest_difference(convolve(tree, GgxLobe::of_alpha(1e-4), 8), sky) < 1e-3);
        CHECK(test::largest_difference(convolve(tree, PhongLobe{1e6f}, 8), sky) < 1e-4);
        // No texel's centre lies in the lobe of these directions.
        const Cube finer = convolve(tree, PhongLobe{1e6f}, 16);
        test::for_each_texel(finer, [&](int face, int x, int y, const float* value) {
            REQUIRE(*value == sky.faces[face].at(x / 2, y / 2));
        });
    }

} // TEST_SUITE
