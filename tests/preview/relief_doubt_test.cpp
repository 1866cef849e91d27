#include "bake/preview/relief_doubt.h"
#include "bake/preview/shape.h"
#include "relief/map/torus_relief.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// What is told of the waves on the unit torus, whose uvs are multiplied by `repeat`.
std::string told(Shade shade, double amplitude, float repeat = 1) {
    Mesh mesh = oracle::torus_mesh(64, 32);
    for (Vec2f& uv : mesh.uvs) uv *= repeat;
    const auto shape = make_shape(std::move(mesh));
    ReliefOptions options;
    options.method.shade = shade;
    options.height = {.amplitude = 2 * amplitude, .midlevel = 0.5};
    return relief_doubt(*shape, oracle::relief_texture({amplitude, 5, 3}, 128), options);
}

/// The number after "up to".
double degrees_of(const std::string& text) {
    const auto at = text.find("up to ");
    return at == std::string::npos ? 0 : std::atof(text.c_str() + at + 6);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("relief_doubt: what is told is the largest angle between the method's normals and the exact ones") {
        for (const double amplitude : {0.04, 0.12}) {
            const oracle::TorusRelief r{amplitude, 5, 3};
            double largest = 0;
            for (int i = 0; i < 100; ++i)
                for (int j = 0; j < 100; ++j) {
                    const Jet<double> s = oracle::unit_torus(0.01 * i, 0.01 * j);
                    const Height<double> h = oracle::relief(r, 0.01 * i, 0.01 * j);
                    largest = std::max(largest, oracle::angle_deg(displaced_normal(s, h, NormalMethod::blinn),
                                                                  displaced_normal(s, h, NormalMethod::exact)));
                }
            CHECK(degrees_of(told(Shade::blinn, amplitude)) == doctest::Approx(largest).epsilon(0.1));
            CHECK(told(Shade::bump, amplitude) == told(Shade::blinn, amplitude));
        }
        CHECK(degrees_of(told(Shade::constant_scale, 0.04)) > degrees_of(told(Shade::blinn, 0.04)));
    }

    TEST_CASE("relief_doubt: nothing is told of exact methods, of low relief, and of a flat height") {
        for (const Shade shade : {Shade::plain, Shade::exact, Shade::normal, Shade::displace})
            CHECK(told(shade, 0.12) == "");
        CHECK(told(Shade::blinn, 0.0005) == "");
        CHECK(told(Shade::constant_scale, 1e-9) == "");
    }

    TEST_CASE("relief_doubt: uvs that repeat are looked up where they lie") {
        // Twice as many waves, twice as steep per length.
        const double once = degrees_of(told(Shade::blinn, 0.04)), twice = degrees_of(told(Shade::blinn, 0.04, 2));
        CHECK(once > 0.318);
        CHECK(twice > 1.3 * once);
        CHECK(degrees_of(told(Shade::blinn, 0.04, -2)) == doctest::Approx(twice).epsilon(0.1));
    }
}
