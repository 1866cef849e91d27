// Samples of light/lobe against their density.
#include "bake/light/lobe.h"
#include "light/chi_square.h"
#include <doctest/doctest.h>
#include <vector>

using namespace bake;
using namespace bake::test;
using namespace bake::test::chi_square;

namespace {

bool finite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("lobe: samples are distributed by their density (chi-square)") {
        constexpr int count = 80000, runs = 5;
        const double each = 1 - std::pow(1 - 0.01, 1.0 / (runs * double(cases().size()))); // Sidak
        for (const Case& c : cases()) {
            CAPTURE(c.name);
            const Vec3f v(direction(c.view, 25));
            const std::vector<double> shares = expected_shares(c.bsdf, v);
            CHECK(std::accumulate(shares.begin(), shares.end() - 1, 0.0) < 1.0005);
            for (int run = 0; run < runs; ++run) {
                std::vector<double> counts = counted(c.bsdf, v, count, std::uint64_t(run) + 1);
                CHECK(p_value(counts, shares, count) > each);
            }
        }
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("lobe: factor times density is the value, and the density is that of pdf()") {
        for (const Case& c : cases()) {
            CAPTURE(c.name);
            const Vec3f v(direction(c.view, 25));
            Random random{3};
            int seen = 0;
            for (int i = 0; i < 500; ++i) {
                const float choice = random.next(), a = random.next(), b = random.next();
                const BsdfSample s = sample(c.bsdf, up, v, choice, {a, b});
                if (s.singular || s.pdf == 0) continue;
                ++seen;
                const Vec3f value = total(evaluate(c.bsdf, up, s.l, v));
                CHECK(std::abs(s.factor.y * s.pdf - value.y) <= 1e-5f * value.y);
                CHECK(std::abs(s.pdf - pdf(c.bsdf, up, s.l, v)) <= 1e-5f * s.pdf);
                CHECK(std::abs(glm::length(s.l) - 1) < 1e-6f);
            }
            CHECK(seen > 100);
        }
    }

    TEST_CASE("lobe: the same numbers give the same sample") {
        for (const Case& c : cases()) {
            const BsdfSample a = sample(c.bsdf, up, up, 0.4f, {0.3f, 0.7f}),
                             b = sample(c.bsdf, up, up, 0.4f, {0.3f, 0.7f});
            CHECK(a.l == b.l);
            CHECK(a.factor == b.factor);
        }
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("lobe: extremes are finite and not negative: exponents, roughnesses, grazing and opposite directions") {
        constexpr float last = 1 - 0x1p-24f;
        std::vector<Bsdf> all;
        for (const float e : {0.f, 1e-6f, 1.f, 1e3f, 1e6f})
            for (const LobeKind kind :
                 {LobeKind::phong, LobeKind::blinn, LobeKind::normalised_phong, LobeKind::normalised_blinn})
                all.push_back(sum_of({cosine_lobe(kind, e)}));
        for (const float r : {0.f, 1e-3f, 0.05f, 1.f})
            for (const float f0 : {0.f, 1e-3f, 0.5f, 1.f}) {
                all.push_back(metallic_roughness(Vec3f(f0), 0.5f, r));
                all.push_back(sum_of({ggx_lobe(r, f0), lobe(LobeKind::mirror, f0), lobe(LobeKind::dielectric, f0)}));
            }
        std::vector<Vec3f> directions = {up, -up, {1, 0, 0}, {0, -1, 0}, Vec3f(0)};
        for (const double theta : {1e-4, 30., 89.999, 90.001, 150.})
            for (const double phi : {0., 100.}) directions.emplace_back(direction(theta, phi));
        std::size_t bad = 0;
        for (const Bsdf& bsdf : all)
            for (const Vec3f& v : directions) {
                for (const Vec3f& l : directions)
                    for (const Vec3f& n : {up, Vec3f(0), Vec3f(direction(150., 40))}) {
                        const Vec3f value = total(evaluate(bsdf, n, l, v));
                        const float density = pdf(bsdf, n, l, v);
                        bad += !finite(value) || !(value.x >= 0) || !std::isfinite(density) || !(density >= 0);
                    }
                for (const float choice : {0.f, 0.5f, last})
                    for (const float a : {0.f, 0.5f, last})
                        for (const float b : {0.f, 0.3f, last}) {
                            const BsdfSample s = sample(bsdf, up, v, choice, {a, b});
                            bad += !finite(s.l) || !finite(s.factor) || !(s.factor.x >= 0) || !std::isfinite(s.pdf);
                            bad += s.factor.x > 100; // no fireflies
                        }
            }
        CHECK(bad == 0);
    }

} // TEST_SUITE
