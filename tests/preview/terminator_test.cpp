#include "bake/preview/terminator.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

const Vec3f up(0, 0, 1);

Vec3f at(double deg) { return {float(std::sin(deg * pi / 180)), 0, float(std::cos(deg * pi / 180))}; }

constexpr Terminator all[] = {Terminator::off, Terminator::flip, Terminator::rotate, Terminator::estevez,
                              Terminator::chiang};

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("terminator: without relief every mode leaves normals and light as they are") {
        for (const Terminator mode : all)
            for (const double angle : {-80.0, 0.0, 40.0, 89.0}) {
                CHECK(mended_normal(mode, up, up, at(angle)) == up);
                CHECK(light_factor(mode, up, up, at(angle)) == doctest::Approx(1).epsilon(1e-5));
            }
    }

    TEST_CASE("terminator: light from below the surface is none, whatever the relief") {
        for (const Terminator mode : all) {
            CHECK(light_factor(mode, at(60), up, at(95)) == 0);
            CHECK(light_factor(mode, at(60), up, at(90.001)) == 0);
            CHECK(light_factor(mode, at(60), up, at(89)) >= 0);
        }
        CHECK(light_factor(Terminator::off, at(60), up, at(89)) == 1);
    }

    TEST_CASE("terminator: estevez and chiang fade to 0 at the surface's horizon, without a step") {
        for (const Terminator mode : {Terminator::estevez, Terminator::chiang}) {
            float before = light_factor(mode, at(40), up, at(0));
            for (double angle = 0.5; angle < 90; angle += 0.5) {
                const float now = light_factor(mode, at(40), up, at(angle));
                CHECK((now >= 0 && now <= 1));
                CHECK(std::abs(now - before) < 0.06f);
                before = now;
            }
            CHECK(before < 0.06f);
        }
    }

    TEST_CASE("terminator: flip turns a normal that faces away towards the viewer, and no other") {
        const Vec3f v = at(70);
        CHECK(mended_normal(Terminator::flip, at(10), up, v) == at(10));
        const Vec3f flipped = mended_normal(Terminator::flip, at(-40), up, v); // 110 degrees from the viewer
        CHECK(glm::dot(flipped, v) == doctest::Approx(-glm::dot(at(-40), v)));
        CHECK(glm::length(flipped) == doctest::Approx(1));
    }

    TEST_CASE("terminator: rotate keeps the mirror direction above the surface, and good normals as they are") {
        for (double view = -85; view <= 85; view += 5)
            for (double tilt = -80; tilt <= 80; tilt += 5) {
                const Vec3f v = at(view), n = at(tilt);
                const Vec3f mended = mended_normal(Terminator::rotate, n, up, v);
                CHECK(glm::length(mended) == doctest::Approx(1).epsilon(1e-5));
                const auto height = [&](const Vec3f& m) { return (2 * glm::dot(m, v) * m - v).z; };
                CHECK(height(mended) > 0);
                CHECK(glm::dot(mended, v) > 0);
                if (height(n) > 0.01f) CHECK(mended == n);
            }
    }

} // TEST_SUITE
