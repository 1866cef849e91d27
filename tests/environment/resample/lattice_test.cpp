#include "bake/environment/resample/lattice.h"
#include "bake/environment/sky/sky_format.h"
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// The centroid of a texel's solid angle relative to the centre of the texel, in texels, from the areas of 32 x 32 parts.
Vec2d measured_centroid(const Lattice& lattice, int x, int y) {
    constexpr int n = 32;
    std::vector<Vec3d> upper(n + 1), lower(n + 1);
    const auto row = [&](int j, std::vector<Vec3d>& directions) {
        lattice.points(x, n, y + double(j) / n, n + 1, directions.data());
        for (Vec3d& d : directions) d = glm::normalize(d);
    };
    Vec2d sum(0);
    double all = 0;
    row(0, lower);
    for (int j = 0; j < n; ++j) {
        std::swap(upper, lower);
        row(j + 1, lower);
        for (int i = 0; i < n; ++i) {
            const double area = glm::length(glm::cross(lower[i + 1] - upper[i], lower[i] - upper[i + 1])) / 2;
            sum += area * Vec2d((i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5);
            all += area;
        }
    }
    return sum / all;
}

/// Largest difference over all texels with at least `border` texels to each side, and the largest centroid.
std::pair<double, double> centroid_errors(const Lattice& lattice, int border) {
    double worst = 0, largest = 0;
    for (int y = border; y < lattice.height() - border; ++y)
        for (int x = border; x < lattice.width() - border; ++x) {
            const Vec2d measured = measured_centroid(lattice, x, y);
            worst = std::max(worst, glm::length(lattice.centroid(x, y) - measured));
            largest = std::max(largest, glm::length(measured));
        }
    return {worst, largest};
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("lattice: the centroid of every projection's texels is that of their solid angle") {
        for (const SkyFormatEntry& format : sky_formats) {
            if (!format.projection || format.discs > 0) continue;
            CAPTURE(std::string(format.name));
            const int width = 24;
            const Lattice lattice(*format.projection, width, width * format.rows / format.columns, glm::dmat3(1));
            // Outer texels of edge-sampled pictures are halves, which the resampler handles itself.
            const auto [worst, largest] = centroid_errors(lattice, format.is_openexr() ? 1 : 0);
            CHECK(worst < 2e-3);
            if (is_latlong(*format.projection)) CHECK(largest > 0.05);
        }
    }

    TEST_CASE("lattice: the centroid of the texels of faces is that of their solid angle") {
        for (const bool edges : {false, true}) {
            const auto [worst, largest] =
                centroid_errors(Lattice(CubeFace::py, 12, edges, glm::dmat3(1)), edges ? 1 : 0);
            CHECK(largest > 0.015);
            CHECK(worst < 0.1 * largest); // first order in the size of the texel
        }
    }

} // TEST_SUITE
