#include "bake/base/vec.h"
#include "bake/light/bsdf.h"
#include <cmath>
#include <doctest/doctest.h>
#include <initializer_list>

using namespace bake;

namespace {

constexpr double radians = pi / 180;

Vec3d at(double degrees) { return {std::sin(degrees * radians), 0, std::cos(degrees * radians)}; }

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("bsdf: diffuse n.l and specular (n.h)^shininess, each times its colour") {
        BlinnPhong<double> surface;
        surface.diffuse = {0.5, 0.25, 0};
        surface.specular = {0, 0.1, 0.2};
        surface.shininess = 10;
        const Vec3d n(0, 0, 1);
        // Light at 50 degrees, viewer at -10: the halfway vector is at 20.
        const Vec3d value = reflected(surface, n, at(50), at(-10));
        const double cosine = std::cos(50 * radians);
        const double lobe = std::pow(std::cos(20 * radians), 10);
        CHECK(value.x == doctest::Approx(0.5 * cosine).epsilon(1e-12));
        CHECK(value.y == doctest::Approx(0.25 * cosine + 0.1 * lobe).epsilon(1e-12));
        CHECK(value.z == doctest::Approx(0.2 * lobe).epsilon(1e-12));
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("bsdf: a light below the surface gives nothing, not even a highlight") {
        BlinnPhong<float> surface;
        surface.specular = Vec3f(1);
        surface.shininess = 0;
        CHECK(reflected(surface, {0, 0, 1}, {0.6f, 0, -0.8f}, {0, 0, 1}) == Vec3f(0));
        CHECK(reflected(surface, {0, 0, 1}, {1, 0, 0}, {0, 0, 1}) == Vec3f(0));
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("bsdf: light opposite to the viewer, no normal, no light: finite and not negative") {
        BlinnPhong<float> surface;
        surface.specular = Vec3f(1);
        for (const Vec3f& n : {Vec3f(0, 0, 1), Vec3f(0)})
            for (const Vec3f& l : {Vec3f(0, 0, 1), Vec3f(0), Vec3f(0.6f, 0, 0.8f)}) {
                const Vec3f value = reflected(surface, n, l, -l);
                for (int c = 0; c < 3; ++c) CHECK((value[c] >= 0 && value[c] <= 2));
            }
    }

} // TEST_SUITE
