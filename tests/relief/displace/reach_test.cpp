#include "bake/relief/displace/reach.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

Mesh square() {
    return polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
}

double waves(double u, double v) { return std::sin(2 * pi * u) + std::sin(2 * pi * v); }

} // namespace

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
