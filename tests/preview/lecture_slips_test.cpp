// What the slips of the lecture's slides cost, in numbers: the table in docs/lecture.md.
#include "bake/light/light.h"
#include "bake/relief/map/displaced_normal.h"
#include "folders.h"
#include "light/lobes.h"
#include "oracle/surfaces.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// N' as the slide has it: b_u in both terms. The sign of the first term is mended on request.
Vec3d as_printed(const Jet<double>& s, const Height<double>& h, bool mended_sign) {
    const Vec3d first = h.b_u * glm::cross(s.n, s.p_v);
    return glm::cross(s.p_u, s.p_v) + (mended_sign ? first : -first) + h.b_u * glm::cross(s.p_u, s.n);
}

struct Errors {
    oracle::Spread printed, second_slope, blinn;
};

/// Angles to the exact normal over the texels of a height on the torus of meshes/torus.obj.
template <class At> Errors errors_on_torus(int n, double R, double r, const At& at) {
    std::vector<double> printed, second_slope, blinn;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double u = (i + 0.5) / n, v = (j + 0.5) / n;
            const Jet<double> s = oracle::torus(R, r, 2 * pi * u, 2 * pi * v);
            const Height<double> h = at(u, v); // slopes per radian
            const Vec3d exact = displaced_normal(s, h, NormalMethod::exact);
            printed.push_back(oracle::angle_deg(as_printed(s, h, false), exact));
            second_slope.push_back(oracle::angle_deg(as_printed(s, h, true), exact));
            blinn.push_back(oracle::angle_deg(displaced_normal(s, h, NormalMethod::blinn), exact));
        }
    return {oracle::spread(printed), oracle::spread(second_slope), oracle::spread(blinn)};
}

void print(const std::string& where, const Errors& e) {
    const auto line = [&](const std::string& what, const oracle::Spread& s) {
        MESSAGE(where << ", " << what << ": mean " << s.mean << ", 95 % " << s.p95 << ", max " << s.max << " degrees");
    };
    line("as printed", e.printed), line("second b_u alone", e.second_slope), line("Blinn", e.blinn);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("slip: r for r^2 in the attenuation makes light r times as bright") {
        for (const double r : {0.25, 1.0, 2.0, 4.0, 10.0}) {
            const double right = attenuation(Attenuation<double>{0, 0, 0.5}, r);
            const double printed = attenuation(Attenuation<double>{0, 0.5, 0}, r); // s_q r is a linear term
            CHECK(printed / right == doctest::Approx(r));
        }
        // With all three terms 1: 1 / (1 + 2 r) for 1 / (1 + r + r^2).
        const double at_4 = (1 + 4. + 16) / (1 + 2 * 4.);
        MESSAGE("constants 1, 1, 1 at r = 4: " << at_4 << " times as bright");
        CHECK(at_4 == doctest::Approx(attenuation(Attenuation<double>{1, 2, 0}, 4.) /
                                      attenuation(Attenuation<double>{1, 1, 1}, 4.)));
    }

    TEST_CASE("slip: b_u in the place of b_v tilts the normals of bricks on a torus by tens of degrees") {
        const HeightTexture bricks = read_height((own_meshes() / "bricks.png").string());
        Image<double> values(bricks.values.width(), bricks.values.height(), 1);
        for (std::size_t i = 0; i < values.size(); ++i) values.data()[i] = double(bricks.values.data()[i]);
        const HeightSampler<double> sampler(values, Interpolation::c2, {.amplitude = 0.03, .midlevel = 0.5});
        const Errors on_bricks = errors_on_torus(512, 1, 0.4, [&](double u, double v) {
            Height<double> h = sampler.at(u, v);
            h.b_u /= 2 * pi, h.b_v /= 2 * pi;
            return h;
        });
        print("bricks", on_bricks);
        const Errors on_waves = errors_on_torus(
            256, 2, 1, [&](double u, double v) { return oracle::waves(0.01, 6, 6, 0, 2 * pi * u, 2 * pi * v); });
        print("egg box", on_waves);
        CHECK(on_bricks.printed.mean > 5 * on_bricks.blinn.mean);
        CHECK(on_bricks.second_slope.mean > 5 * on_bricks.blinn.mean);
        CHECK(on_waves.printed.max > 7);
        CHECK(on_waves.blinn.max < 0.02);
    }

    TEST_CASE("slip: a constant f whose integral is 1 has the albedo 1/2, and white Lambert has the integral 2") {
        const auto integral = [](const Bsdf& bsdf, bool with_cosine) {
            const int rings = 2000;
            double sum = 0;
            for (int i = 0; i < rings; ++i) {
                const double cosine = (i + 0.5) / rings; // equal solid angles
                const Vec3d l(std::sqrt(1 - cosine * cosine), 0, cosine);
                const double f_cos = double(evaluate(bsdf, up, Vec3f(l), up).diffuse.x);
                sum += (with_cosine ? f_cos : f_cos / cosine) * 2 * pi / rings;
            }
            return sum;
        };
        const Bsdf grey = sum_of({lobe(LobeKind::lambert, 0.5f)}), white = sum_of({lobe(LobeKind::lambert, 1)});
        CHECK(integral(grey, false) == doctest::Approx(1).epsilon(1e-5)); // f = 1 / (2 pi)
        CHECK(integral(grey, true) == doctest::Approx(0.5).epsilon(1e-5));
        CHECK(integral(white, false) == doctest::Approx(2).epsilon(1e-5));
        CHECK(integral(white, true) == doctest::Approx(1).epsilon(1e-5));
    }

} // TEST_SUITE
