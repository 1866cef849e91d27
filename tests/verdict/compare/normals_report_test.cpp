#include "bake/base/vec.h"
#include "bake/verdict/compare/normals_report.h"
#include "verdict/compare/files.h"
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

/// Unit normals of a relief with slopes along both axes, turned about the x axis by degrees; y up.
Vec3d normal(int x, int y, double turn_deg = 0) {
    const Vec3d n = glm::normalize(Vec3d(0.4 * std::sin(0.35 * x + 0.2 * y), 0.3 * std::cos(0.3 * y - 0.15 * x), 1));
    const double c = std::cos(turn_deg * pi / 180), s = std::sin(turn_deg * pi / 180);
    return {n.x, c * n.y - s * n.z, s * n.y + c * n.z};
}

/// As rgb = (n + 1) / 2, or n itself.
Image<float> map(double turn_deg, bool as_signed = false, bool directx = false, double length = 1) {
    return picture(48, 40, 3, [=](int x, int y, int c) {
        const double v = length * normal(x, y, turn_deg)[c] * (directx && c == 1 ? -1 : 1);
        return as_signed ? v : 0.5 * (v + 1);
    });
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("normals_report: a rotation by an angle has that angle at each pixel") {
        const Files files;
        const std::string a = files.exr("a.exr", map(0));
        for (const double turn : {0.01, 1.0, 7.0}) {
            const NormalsReport r = compare_normals(a, files.exr("b.exr", map(turn)));
            // The turn is about x: less for vectors that lean along it.
            double mean = 0, max = 0;
            for (int y = 0; y < 40; ++y)
                for (int x = 0; x < 48; ++x) {
                    const double angle =
                        std::acos(std::min(1.0, glm::dot(normal(x, y), normal(x, y, turn)))) * 180 / pi;
                    mean += angle / (48 * 40);
                    max = std::max(max, angle);
                }
            CHECK(r.angles.mean == doctest::Approx(mean).epsilon(1e-3));
            CHECK(r.angles.max == doctest::Approx(max).epsilon(1e-3));
            CHECK(r.angles.max <= turn * 1.001);
            CHECK(r.angles.p95 <= r.angles.p99);
        }
        CHECK(compare_normals(a, a).angles.max == 0);
    }

    TEST_CASE("normals_report: green, encoding and length are told apart before angles are measured") {
        const Files files;
        const std::string a = files.exr("a.exr", map(0));
        const NormalsReport green = compare_normals(a, files.exr("green.exr", map(0, false, true)));
        CHECK(green.green_turned);
        CHECK(green.angles.max < 1e-4);
        CHECK(has(to_text(green), "green          opposed"));
        const NormalsReport encoding = compare_normals(a, files.exr("signed.exr", map(0, true)));
        CHECK(encoding.other_values.encoding == NormalEncoding::signed_);
        CHECK_FALSE(encoding.green_turned);
        CHECK(encoding.angles.max < 1e-4);
        CHECK(nlohmann::json::parse(to_json(encoding))["encoding"][1] == "n = rgb");
        const NormalsReport both = compare_normals(a, files.exr("both.exr", map(0, true, true)));
        CHECK(both.green_turned);
        CHECK(both.angles.max < 1e-4);
        CHECK(compare_normals(a, files.exr("long.exr", map(0, false, false, 0.98))).angles.max < 1e-4);
        // 8 bits: an angle of up to asin(sqrt(3) / 255), 0.39 degrees.
        const NormalsReport levels = compare_normals(a, files.png("levels.png", map(0)));
        CHECK(levels.angles.max < 0.39);
        CHECK(levels.angles.mean > 0.05);
    }

    TEST_CASE("normals_report: an inverted relief is no convention, but a warning") {
        const Files files;
        const auto inverted =
            picture(48, 40, 3, [](int x, int y, int c) { return 0.5 * ((c < 2 ? -1 : 1) * normal(x, y)[c] + 1); });
        const NormalsReport r = compare_normals(files.exr("a.exr", map(0)), files.exr("b.exr", inverted));
        CHECK_FALSE(r.green_turned);
        REQUIRE(r.findings.warnings.size() == 1);
        CHECK(has(r.findings.warnings[0], "inverted"));
        CHECK(r.angles.mean > 10);
        CHECK_FALSE(r.over_limit);
    }

    TEST_CASE("normals_report: in object space there is no green to turn, and pixels without direction are left out") {
        const Files files;
        // A ball: normals to all sides in the disc, 0 around it.
        const auto ball = [](double flip) {
            return picture(40, 40, 3, [=](int x, int y, int c) {
                const Vec3d p((x - 19.5) / 18, (19.5 - y) / 18, 0);
                const double z2 = 1 - p.x * p.x - p.y * p.y;
                if (z2 < 0) return 0.0;
                return c == 0 ? p.x : c == 1 ? flip * p.y : -std::sqrt(z2); // away from the viewer: z below 0
            });
        };
        const std::string a = files.exr("a.exr", ball(1)), b = files.exr("b.exr", ball(-1));
        const NormalsReport same = compare_normals(a, a, {.space = NormalSpace::object});
        CHECK(same.angles.max == 0);
        CHECK(same.values.encoding == NormalEncoding::signed_);
        CHECK(same.left_out > 0);
        CHECK(same.left_out < 40 * 40 / 2);
        const NormalsReport turned = compare_normals(a, b, {.space = NormalSpace::object});
        CHECK_FALSE(turned.green_turned);
        CHECK(turned.angles.max > 90);
        const auto stored = picture(40, 40, 3, [&](int x, int y, int c) { return 0.5 * (normal(x, y)[c] + 1); });
        CHECK(compare_normals(files.exr("c.exr", stored), files.exr("c.exr", stored), {.space = NormalSpace::object})
                  .values.encoding == NormalEncoding::unorm);
    }

    TEST_CASE("normals_report: refusals and limits") {
        const Files files;
        const std::string a = files.exr("a.exr", map(0)), b = files.exr("b.exr", map(3));
        const auto said = [&](const std::string& other, const NormalsCompareOptions& options = {}) {
            return refusal(Refusal::unsuitable, [&] { compare_normals(a, other, options); });
        };
        CHECK(has(said(files.exr("small.exr", noisy(4, 4, 1))), "small.exr: is 4 x 4, where "));
        const auto channels = [](int n) { return picture(48, 40, n, [](int, int, int) { return 0.5; }); };
        CHECK(has(said(files.exr("one.exr", channels(1))), "has 1 channel, where normals have two or three"));
        Image<float> bad = map(0);
        bad.at(7, 8, 2) = std::numeric_limits<float>::infinity();
        CHECK(has(said(files.exr("bad.exr", bad)), "bad.exr: 1 pixel is NaN or Inf, the first at column 7, row 8"));
        CHECK(compare_normals(a, b, {.limits = {{"angle", 1}}}).over_limit);
        CHECK_FALSE(compare_normals(a, b, {.limits = {{"angle-max", 3.1}}}).over_limit);
        CHECK(has(refusal(Refusal::usage, [&] { compare_normals(a, b, {.limits = {{"flip", 1}}}); }), "angle-p95"));
    }

    TEST_CASE("normals_report: small angles are accurate") {
        for (const double angle : {1e-9, 1e-4, 1.0, 90.0, 179.9999})
            CHECK(angle_deg({0, 0, 3}, {std::sin(angle * pi / 180), 0, std::cos(angle * pi / 180)}) ==
                  doctest::Approx(angle).epsilon(1e-9));
    }
}
