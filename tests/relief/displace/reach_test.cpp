#include "bake/base/error.h"
#include "bake/relief/displace/reach.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

Mesh square() {
    return polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
}

double waves(double u, double v) { return std::sin(2 * pi * u) + std::sin(2 * pi * v); }

/// The error that the refusal names as one that can be reached; 0 if there is no refusal.
double named_instead_of(double error) {
    DisplaceOptions options;
    options.rates.rule = Rates::Rule::error;
    options.rates.error = error;
    options.max_bytes = 2 << 20;
    try {
        displace(BaseSurface(square()), relief(picture(64, 64, waves), 0.02, 0), options);
        return 0;
    } catch (const Error& refusal) {
        const std::string words = "set `rates.error` to ", text = refusal.what();
        const std::size_t at = text.find(words);
        REQUIRE_MESSAGE(at != std::string::npos, text);
        return std::stod(text.substr(at + words.size()));
    }
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("reach: the error that a refusal names is near what can be reached, and is not refused itself") {
        int refused = 0;
        for (double error = 1e-3; error > 1e-8; error /= 3) {
            const double named = named_instead_of(error);
            if (named == 0) {
                CHECK(refused == 0); // a smaller error needs more
                continue;
            }
            ++refused;
            CAPTURE(error);
            CAPTURE(named);
            CHECK(named > error);
            CHECK(named_instead_of(named) == 0);
            CHECK(named_instead_of(named / 6) > 0);
        }
        CHECK(refused > 3);
    }
}

TEST_SUITE("oracle") {

    TEST_CASE(
        "need_of: the segments and triangles of a wave along each side of a square, by the integral of its curvature") {
        const BaseSurface base(square());
        const double amplitude = 0.02, error = 1e-7;
        const Relief height = relief(picture(256, 256, waves), amplitude, 0);
        const ErrorNeed need = need_of(seamed(base, height, Seam::average), error, nullptr);
        // A chord of length h is b'' h^2 / 8 off: even segments by the largest b'', others by the mean root of it.
        CHECK(need.most == doctest::Approx(std::sqrt(4 * pi * pi * amplitude / (8 * error))).epsilon(0.01));
        CHECK(need.segments == need.most);
        const double mean_root = std::tgamma(0.75) / (std::sqrt(pi) * std::tgamma(1.25)); // of |sin|
        const double scale = std::sqrt(4 * pi * pi * amplitude / 8) * mean_root;
        CHECK(need.scale == doctest::Approx(2 * scale * scale).epsilon(0.01));
        CHECK(need.triangles == doctest::Approx(2 * scale * scale / error).epsilon(0.01));
    }
}
