#include "bake/light/cosine_power.h"
#include "bake/light/ggx_albedo.h"
#include "bake/light/lobe.h"
#include "light/lobes.h"
#include <doctest/doctest.h>
#include <initializer_list>

using namespace bake;
using namespace bake::test;

namespace {

const std::initializer_list<double> views = {0, 30, 60, 80, 88};

double ratio(const Bsdf& bsdf, const Vec3d& l, const Vec3d& v) {
    const double there = double(total(evaluate(bsdf, up, Vec3f(l), Vec3f(v))).y) / l.z;
    const double back = double(total(evaluate(bsdf, up, Vec3f(v), Vec3f(l))).y) / v.z;
    return there / back;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("lobe: lambert reflects its weight") {
        for (const double view : views)
            CHECK(albedo(sum_of({lobe(LobeKind::lambert, 0.7f)}), direction(view)) ==
                  doctest::Approx(0.7).epsilon(1e-3));
    }

    TEST_CASE("lobe: ggx of weight 1 reflects all light, at every roughness and angle") {
        for (const float roughness : {0.05f, 0.1f, 0.2f, 0.35f, 0.6f, 0.8f, 1.f})
            for (const double view : views) {
                CAPTURE(roughness);
                CAPTURE(view);
                if (view < 85 || roughness > 0.3f)
                    CHECK(albedo(sum_of({ggx_lobe(roughness)}), direction(view)) == doctest::Approx(1).epsilon(1e-3));
                CHECK(sampled_albedo(sum_of({ggx_lobe(roughness)}), up, Vec3f(direction(view))) ==
                      doctest::Approx(1).epsilon(1e-3));
            }
    }

    TEST_CASE("lobe: lambert of weight 1 under any ggx adds up to 1; a base of 1 reflects at most 1") {
        Lobe covered = lobe(LobeKind::lambert);
        covered.covered = true;
        for (const float roughness : {0.1f, 0.3f, 1.f})
            for (const float f0 : {0.f, 0.04f, 0.5f, 1.f})
                for (const double view : {0., 60., 85.}) {
                    CAPTURE(roughness);
                    CAPTURE(f0);
                    CAPTURE(view);
                    CHECK(albedo(sum_of({covered, ggx_lobe(roughness, f0)}), direction(view)) ==
                          doctest::Approx(1).epsilon(2e-3));
                    for (const float metallic : {0.f, 0.5f, 1.f}) {
                        const double a = sampled_albedo(metallic_roughness(Vec3f(1), metallic, roughness), up,
                                                        Vec3f(direction(view)), 1 << 12);
                        CHECK(a < 1.002);
                        if (metallic != 0.5f) CHECK(a > 0.998);
                    }
                }
    }

    TEST_CASE("lobe: ggx of reflectance f0 at normal incidence reflects f0 where it is smooth") {
        for (const float f0 : {0.04f, 0.3f, 0.9f})
            CHECK(sampled_albedo(sum_of({ggx_lobe(0.05f, f0)}), up, up) == doctest::Approx(double(f0)).epsilon(1e-3));
    }

    TEST_CASE("lobe: light of several bounces is the sum of the bounces' reflectances") {
        for (const float f0 : {0.04f, 0.3f, 0.8f}) {
            const GgxRow row = ggx_row(1);
            const GgxAlbedo once = ggx_albedo(row, 0.5f), mean = ggx_mean_albedo(row);
            const double f = double(f0) + (1 - double(f0)) / 21, lost = double(mean.loss);
            double sum = double(f0 * (1 - once.loss - once.schlick) + once.schlick);
            // Two bounces, of which the second leaves the surface; three; ...
            for (int bounces = 2; bounces < 60; ++bounces)
                sum += double(once.loss) * std::pow(f, bounces) * std::pow(lost, bounces - 2) * (1 - lost);
            CHECK(sampled_albedo(sum_of({ggx_lobe(1, f0)}), up, Vec3f(direction(60))) ==
                  doctest::Approx(sum).epsilon(3e-3));
        }
    }

    TEST_CASE("lobe: the lecture's lobes have the albedo of their closed forms") {
        for (const double n : {0., 1., 5., 20., 300.}) {
            CAPTURE(n);
            const float e = float(n);
            const auto normal = [&](LobeKind kind) {
                return albedo(sum_of({cosine_lobe(kind, e)}), direction(0), 600, 16);
            };
            const double corner = n < 2 ? 1e-2 : 1e-3; // ends with a step at the horizon
            CHECK(normal(LobeKind::phong) == doctest::Approx(2 / (n + 1)).epsilon(corner));
            CHECK(phong_albedo(n) == doctest::Approx(2 * pi / (n + 1)));
            CHECK(normal(LobeKind::blinn) == doctest::Approx(blinn_albedo(n) / pi).epsilon(corner));
            CHECK(normal(LobeKind::normalised_phong) == doctest::Approx(1).epsilon(1e-3));
            CHECK(normal(LobeKind::normalised_blinn) == doctest::Approx(1).epsilon(1e-3));
            CHECK(phong_cosine_albedo(n) == doctest::Approx(2 * pi / (n + 2)));
        }
        CHECK((8 + 8) / (8 * pi) * blinn_cosine_albedo(8) == doctest::Approx(1.075).epsilon(1e-3)); // the usual factor
        // The lecture's Phong conserves energy from n = 2 pi - 1 on; with the cosine from 2 pi - 2 on.
        CHECK(phong_albedo(2 * pi - 1) == doctest::Approx(1));
        CHECK(phong_cosine_albedo(2 * pi - 2) == doctest::Approx(1));
    }

    TEST_CASE(
        "lobe: the normalised lobes reflect at most 1 at any angle, the lecture's no more than at normal incidence") {
        for (const float n : {0.f, 0.5f, 2.f, 8.f, 100.f})
            for (const double view : {20., 50., 70., 85.}) {
                CAPTURE(n);
                CAPTURE(view);
                for (const LobeKind kind : {LobeKind::normalised_phong, LobeKind::normalised_blinn})
                    CHECK(sampled_albedo(sum_of({cosine_lobe(kind, n)}), up, Vec3f(direction(view)), 1 << 12) < 1.01);
                CHECK(sampled_albedo(sum_of({cosine_lobe(LobeKind::phong, n)}), up, Vec3f(direction(view)), 1 << 12) <
                      phong_albedo(double(n)) / pi * 1.01);
                CHECK(sampled_albedo(sum_of({cosine_lobe(LobeKind::blinn, n)}), up, Vec3f(direction(view)), 1 << 12) <
                      blinn_albedo(double(n)) / pi * 1.01);
            }
    }

    TEST_CASE("lobe: phong and blinn reflect weight times the cosine's power of a light with irradiance pi") {
        const Vec3d l = direction(50), v = direction(10, 180); // the halfway vector is at 20 degrees, r.v at 40
        for (const double n : {1., 10., 200.}) {
            const auto value = [&](LobeKind kind) {
                return double(
                           evaluate(sum_of({cosine_lobe(kind, float(n), 0.3f)}), up, Vec3f(l), Vec3f(v)).specular.x) *
                       pi;
            };
            CHECK(value(LobeKind::phong) == doctest::Approx(0.3 * std::pow(std::cos(40 * pi / 180), n)).epsilon(1e-4));
            CHECK(value(LobeKind::blinn) == doctest::Approx(0.3 * std::pow(std::cos(20 * pi / 180), n)).epsilon(1e-4));
            CHECK(value(LobeKind::normalised_phong) ==
                  doctest::Approx(0.3 * (n + 2) / 2 * std::pow(std::cos(40 * pi / 180), n) * l.z).epsilon(1e-4));
        }
    }

    TEST_CASE("lobe: the lecture's phong is not reciprocal, the normalised one is") {
        const Vec3d a = direction(20), b = direction(70, 180);
        const double expected = std::cos(70 * pi / 180) / std::cos(20 * pi / 180); // 0.364
        CHECK(expected == doctest::Approx(0.364).epsilon(1e-3));
        for (const LobeKind kind : {LobeKind::phong, LobeKind::blinn})
            CHECK(ratio(sum_of({cosine_lobe(kind, 5)}), a, b) == doctest::Approx(expected).epsilon(1e-4));
    }

    TEST_CASE("lobe: lambert, normalised lobes, ggx and lambert under it are reciprocal") {
        Lobe covered = lobe(LobeKind::lambert);
        covered.covered = true;
        const Bsdf all[] = {sum_of({lobe(LobeKind::lambert)}),
                            sum_of({cosine_lobe(LobeKind::normalised_phong, 20)}),
                            sum_of({cosine_lobe(LobeKind::normalised_blinn, 20)}),
                            sum_of({ggx_lobe(0.3f, 0.5f)}),
                            sum_of({covered, ggx_lobe(0.5f, 0.04f)}),
                            metallic_roughness(Vec3f(0.5f), 0.3f, 0.7f)};
        for (const Bsdf& bsdf : all)
            for (const double l : {5., 40., 75.})
                for (const double v : {10., 60., 85.})
                    for (const double turn : {100., 140., 180.}) // where no lobe is 0
                        CHECK(ratio(bsdf, direction(l), direction(v, turn)) == doctest::Approx(1).epsilon(1e-3));
    }

    TEST_CASE("lobe: glTF's material at normal incidence, where its appendix B has 0.04 and the base colour") {
        const Bsdf plastic = metallic_roughness({0.8f, 0.4f, 0.2f}, 0, 1),
                   metal = metallic_roughness({0.8f, 0.4f, 0.2f}, 1, 0.5f);
        CHECK(plastic.lobes[0].weight.x == doctest::Approx(0.04));
        CHECK(plastic.lobes[1].weight == Vec3f(0.8f, 0.4f, 0.2f));
        CHECK(metal.lobes[0].weight == Vec3f(0.8f, 0.4f, 0.2f));
        CHECK(metal.lobes[1].weight == Vec3f(0));
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("lobe: the sum of lobes is the sum of their values") {
        const Lobe a = lobe(LobeKind::lambert, 0.3f), b = cosine_lobe(LobeKind::blinn, 20, 0.4f),
                   c = ggx_lobe(0.4f, 0.2f);
        Random random{7};
        for (int i = 0; i < 100; ++i) {
            const Vec3f l = random.unit(), v = random.unit();
            const BsdfValue sum = evaluate(sum_of({a, b, c}), up, l, v);
            CHECK(double(sum.diffuse.y) == doctest::Approx(double(evaluate(sum_of({a}), up, l, v).diffuse.y)));
            CHECK(double(sum.specular.y) == doctest::Approx(double(evaluate(sum_of({b}), up, l, v).specular.y) +
                                                            double(evaluate(sum_of({c}), up, l, v).specular.y)));
            if (l.z <= 0) CHECK(total(sum) == Vec3f(0));
        }
        CHECK(total(evaluate(Bsdf{}, up, up, up)) == Vec3f(0));
        CHECK(sample(Bsdf{}, up, up, 0.5f, {0.5f, 0.5f}).factor == Vec3f(0));
    }

    TEST_CASE("lobe: what stands behind the last lobe does not count") {
        const Bsdf two = metallic_roughness(Vec3f(0.5f), 0, 0.3f);
        REQUIRE(cover(two, up, Vec3f(direction(60))).x < 1);
        Bsdf one = two;
        one.count = 1; // lobes[1] is still a covered one
        CHECK(cover(one, up, Vec3f(direction(60))) == Vec3f(1));
        CHECK(total(evaluate(one, up, Vec3f(direction(20)), Vec3f(direction(60)))) ==
              total(evaluate(sum_of({two.lobes[0]}), up, Vec3f(direction(20)), Vec3f(direction(60)))));
    }

    TEST_CASE("lobe: turning all vectors changes nothing") {
        const Bsdf bsdf =
            sum_of({lobe(LobeKind::lambert, 0.3f), cosine_lobe(LobeKind::phong, 9), ggx_lobe(0.3f, 0.5f)});
        const Vec3d l = direction(40, 20), v = direction(60, 210);
        const auto turned = [](const Vec3d& a) { return Vec3f(Vec3d(a.z, a.x, a.y)); };
        const Vec3f here = total(evaluate(bsdf, up, Vec3f(l), Vec3f(v)));
        const Vec3f there = total(evaluate(bsdf, Vec3f(1, 0, 0), turned(l), turned(v)));
        CHECK(double(here.x) == doctest::Approx(double(there.x)).epsilon(1e-5));
        for (const Vec3f& n : {Vec3f(0, 0, -1), Vec3f(0, -1, 0), Vec3f(1, 0, 0)}) {
            const double a = sampled_albedo(bsdf, up, up, 1 << 12), b = sampled_albedo(bsdf, n, n, 1 << 12);
            CHECK(a == doctest::Approx(b).epsilon(1e-4));
        }
    }

    TEST_CASE("lobe: a mirror reflects by Schlick in one direction") {
        const Bsdf mirror = sum_of({lobe(LobeKind::mirror, 0.2f)});
        const Vec3f v(direction(60));
        const BsdfSample s = sample(mirror, up, v, 0.3f, {0.9f, 0.1f});
        CHECK(s.singular);
        CHECK(s.specular);
        CHECK(glm::length(s.l - Vec3f(direction(60, 180))) < 1e-6f);
        CHECK(double(s.factor.x) == doctest::Approx(0.2 + 0.8 / 32));
        CHECK(total(evaluate(mirror, up, s.l, v)) == Vec3f(0));
        CHECK(pdf(mirror, up, s.l, v) == 0);
        // In a sum each lobe has its share: the mean over the choices is what both reflect.
        const Bsdf both = sum_of({lobe(LobeKind::mirror, 0.2f), lobe(LobeKind::lambert, 0.5f)});
        CHECK(sampled_albedo(both, up, v) == doctest::Approx(0.2 + 0.8 / 32 + 0.5).epsilon(1e-3));
    }

} // TEST_SUITE
TEST_SUITE("oracle") {

    TEST_CASE("lobe: a dielectric reflects and refracts by Fresnel, and loses nothing") {
        const Bsdf glass = sum_of({lobe(LobeKind::dielectric)});
        const auto reflected = [&](const Vec3f& v) { // share of samples on the side of v
            int count = 0;
            for (int i = 0; i < 4096; ++i)
                count += sample(glass, up, v, 0, {(float(i) + 0.5f) / 4096, 0}).l.z * v.z > 0;
            return count / 4096.;
        };
        CHECK(reflected(up) == doctest::Approx(0.04).epsilon(0.01));
        CHECK(reflected(-up) == doctest::Approx(0.04).epsilon(0.01));
        CHECK(reflected(Vec3f(direction(100))) > 0.999); // from inside beyond the critical angle of 41.8 degrees
        // Brewster's angle, tan = 1.5: half of the reflectance of the perpendicular polarisation, ((1.5^2 - 1) / (1.5^2 + 1))^2 / 2.
        CHECK(reflected(Vec3f(direction(std::atan(1.5) * 180 / pi))) == doctest::Approx(0.07396).epsilon(0.01));
        // Snell's law, both ways; and back along the same path.
        const BsdfSample in = sample(glass, up, Vec3f(direction(60)), 0, {0.999f, 0});
        CHECK(double(in.l.x) == doctest::Approx(-std::sin(60 * pi / 180) / 1.5));
        CHECK(in.l.z < 0);
        const BsdfSample out = sample(glass, up, in.l, 0, {0.999f, 0});
        CHECK(glm::length(out.l - Vec3f(direction(60))) < 1e-5f);
        for (const double view : {0., 50., 89., 90., 95., 130., 140., 180.}) {
            CAPTURE(view);
            CHECK(sampled_albedo(glass, up, Vec3f(direction(view)), 1024) == doctest::Approx(1));
        }
    }

} // TEST_SUITE
