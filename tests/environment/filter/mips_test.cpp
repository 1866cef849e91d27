#include "bake/base/parallel.h"
#include "bake/environment/filter/mips.h"
#include "environment/skies.h"
#include <doctest/doctest.h>
#include <numbers>

using namespace bake;

namespace {

enum class MipFilter { tent, box };

Cube next_mip_by(MipFilter filter, const Cube& sky) {
    return filter == MipFilter::tent ? next_mip(sky) : resize_by_area(sky, std::max(1, sky.size() / 2));
}

std::vector<Cube> mip_chain_by(MipFilter filter, const Cube& sky) {
    std::vector<Cube> chain;
    chain.push_back(resize_by_area(sky, sky.size()));
    while (chain.back().size() > 1) chain.push_back(next_mip_by(filter, chain.back()));
    return chain;
}

constexpr MipFilter filters[] = {MipFilter::tent, MipFilter::box};

/// A black sky with one texel of unit flux.
Cube unit_flux_texel(int n, int face, int x, int y) {
    Cube sky = test::even_sky(n, 1, 0);
    sky.faces[face].at(x, y) = float(1 / test::texel_solid_angle(n, x, y));
    return sky;
}

double smallest(const Cube& cube) {
    float least = cube.faces[0].data()[0];
    for (const Image<float>& face : cube.faces)
        least = std::min(least, *std::min_element(face.data(), face.data() + face.size()));
    return double(least);
}

/// Mean step across the twelve edges over the mean step between neighbours inside the faces. A texel's neighbour across
/// an edge is the nearest texel of another face.
double seam_ratio(const Cube& cube) {
    const int n = cube.size();
    double across = 0, inside = 0;
    int across_count = 0, inside_count = 0;
    const auto step = [&](const float* a, const float* b) { return std::abs(double(a[0]) - double(b[0])); };
    test::for_each_texel(cube, [&](int face, int x, int y, const float* value) {
        if (x + 1 < n) inside += step(value, &cube.faces[face].at(x + 1, y)), ++inside_count;
        if (y + 1 < n) inside += step(value, &cube.faces[face].at(x, y + 1)), ++inside_count;
        for (int other = 0; other < 6; ++other) {
            // Across the edge to `other`, when (x, y) lies along it.
            const Vec3d towards = test::face_direction(other, 0, 0), here = test::texel_direction(n, face, x, y);
            const double highest =
                glm::dot(glm::normalize(test::face_direction(face, 0, 0) + towards * (1 - 1.0 / n)), towards);
            const double along = glm::dot(here, towards) / glm::dot(here, test::face_direction(face, 0, 0));
            if (other / 2 == face / 2 || std::abs(along - (1 - 1.0 / n)) > 1e-9 || highest < 0) continue;
            double nearest = -2;
            const float* neighbour = nullptr;
            for (int i = 0; i < n; ++i)
                for (const auto& [a, b] : {std::pair{i, 0}, {i, n - 1}, {0, i}, {n - 1, i}})
                    if (const double near = glm::dot(here, test::texel_direction(n, other, a, b)); near > nearest)
                        nearest = near, neighbour = &cube.faces[other].at(a, b);
            across += step(value, neighbour), ++across_count;
        }
    });
    REQUIRE(across_count == 24 * n);
    return across / across_count / (inside / inside_count);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("mips: a texel of unit flux keeps it down to 1 x 1, wherever it is and whatever the size") {
        for (const MipFilter filter : filters)
            for (const int n : {16, 17, 3}) {
                double worst = 0;
                for (int y = 0; y < n; ++y)
                    for (int x = 0; x <= y; ++x) // the other half is its mirror
                        for (const Cube& level : mip_chain_by(filter, unit_flux_texel(n, (x + y) % 6, x, y)))
                            worst = std::max(worst, std::abs(test::flux(level) - 1));
                // Values are floats, sums are double.
                CHECK(worst < 1e-6);
            }
    }

    TEST_CASE("mips: a box mip is the sky's mean over its texel") {
        // Against the sky itself: what is left is the midpoint rule of the finest texels, of second order.
        const auto error = [](int n) {
            const Cube mip = resize_by_area(test::sky_of(n, 1, test::smooth_radiance), 4);
            double most = 0;
            test::for_each_texel(mip, [&](int face, int x, int y, const float* value) {
                constexpr int fine = 400;
                double sum = 0, area = 0;
                for (int j = 0; j < fine / 4; j += 4)
                    for (int i = 0; i < fine / 4; i += 4) {
                        const double sc = (2 * (x * fine / 4 + i) + 4.0) / fine - 1,
                                     tc = (2 * (y * fine / 4 + j) + 4.0) / fine - 1;
                        const double omega = std::pow(1 + sc * sc + tc * tc, -1.5);
                        sum += omega * test::smooth_radiance(test::face_direction(face, sc, tc), 0), area += omega;
                    }
                most = std::max(most, std::abs(double(*value) - sum / area));
            });
            return most;
        };
        CHECK(error(16) < 2e-3);
        CHECK(error(8) / error(16) == doctest::Approx(4).epsilon(0.15));
    }

    TEST_CASE("mips: no seam shows at any level of a smooth sky") {
        const auto slope = [](const Vec3d& d, int) { return 2 + 0.9 * d.x - 0.3 * d.y + 0.2 * d.z; };
        for (const MipFilter filter : filters) {
            // 1 x 1 has no inside to compare with.
            for (const Cube& level : mip_chain_by(filter, test::sky_of(64, 1, test::smooth_radiance)))
                if (level.size() > 1) CHECK_MESSAGE(seam_ratio(level) <= 1.02, level.size());
            // On 24 texels the ratio is the sky's own affair: exact means of this slope have 1.11.
            for (const Cube& level : mip_chain_by(filter, test::sky_of(64, 1, slope)))
                if (level.size() > 2) CHECK_MESSAGE(seam_ratio(level) <= 1.02, level.size());
        }
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("mips: levels halve down to one texel, with all channels") {
        for (const int channels : {1, 2, 3, 4}) {
            const std::vector<Cube> chain = mip_chain(test::rough_sky(20, channels));
            REQUIRE(chain.size() == 5);
            for (std::size_t level = 0; level < chain.size(); ++level) {
                CHECK(chain[level].size() == 20 >> level);
                CHECK(chain[level].faces[5].channels() == channels);
            }
            CHECK(test::same_bytes(chain[0], test::rough_sky(20, channels)));
        }
        CHECK(mip_chain(test::even_sky(1, 3, 1)).size() == 1);
    }

    TEST_CASE("mips: an even sky stays as it is") {
        for (const MipFilter filter : filters)
            for (const int n : {32, 19, 2})
                for (const double radiance : {1.0, 0.0, -3.7, 1e6})
                    for (const Cube& level : mip_chain_by(filter, test::even_sky(n, 3, radiance)))
                        // A corner's mean of three may round.
                        CHECK(test::largest_difference(level, test::even_sky(level.size(), 3, radiance)) <=
                              1.2e-7 * std::abs(radiance));
    }

    TEST_CASE("mips: the tent hands light across edges, and at a corner to three faces alike") {
        const auto lit_faces = [](int x, int y, MipFilter filter) {
            const Cube mip = next_mip_by(filter, unit_flux_texel(16, 4, x, y));
            int faces = 0;
            for (const Image<float>& face : mip.faces)
                faces += *std::max_element(face.data(), face.data() + face.size()) > 0;
            return faces;
        };
        CHECK(lit_faces(8, 8, MipFilter::tent) == 1);
        CHECK(lit_faces(0, 8, MipFilter::tent) == 2);
        CHECK(lit_faces(0, 0, MipFilter::tent) == 3);
        CHECK(lit_faces(0, 0, MipFilter::box) == 1);
        // Corner texels of pz, nx, py meet at (-1, 1, 1). Each gives the others 1/8 beside, 1/16 to the mean of three, of
        // which a third is its own, and 1/16 to each texel next to them: the two faces are treated alike.
        const Cube mip = next_mip(unit_flux_texel(16, 4, 0, 0));
        const auto share = [&](int face) {
            double sum = 0;
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x) sum += double(mip.faces[face].at(x, y)) * test::texel_solid_angle(8, x, y);
            return sum;
        };
        const double own = test::texel_solid_angle(16, 0, 0), beside = test::texel_solid_angle(16, 1, 0);
        const double given = 1.0 / 8 + 1.0 / 16 / 3 + 1.0 / 16 * 2 * beside / (own + beside);
        CHECK(share(1) == doctest::Approx(given).epsilon(1e-6));
        CHECK(share(2) == doctest::Approx(given).epsilon(1e-6));
    }

    TEST_CASE("mips: the filters are linear, and a turned sky has turned mips") {
        for (const MipFilter filter : filters) {
            const Cube a = test::rough_sky(18, 2, 1), b = test::rough_sky(18, 2, 2);
            Cube sum = test::even_sky(18, 2, 0);
            for (int face = 0; face < 6; ++face)
                for (std::size_t i = 0; i < sum.faces[face].size(); ++i)
                    sum.faces[face].data()[i] = 2 * a.faces[face].data()[i] - b.faces[face].data()[i];
            const Cube mip_a = next_mip_by(filter, a), mip_b = next_mip_by(filter, b),
                       mip_sum = next_mip_by(filter, sum);
            double worst = 0;
            for (int face = 0; face < 6; ++face)
                for (std::size_t i = 0; i < mip_sum.faces[face].size(); ++i)
                    worst =
                        std::max(worst, std::abs(double(2 * mip_a.faces[face].data()[i] - mip_b.faces[face].data()[i] -
                                                        mip_sum.faces[face].data()[i])));
            CHECK(worst < 2e-5); // floats up to about 60
            for (const auto turn : {test::quarter_about_y, test::third_about_diagonal, test::mirror_x})
                CHECK(test::largest_difference(next_mip_by(filter, test::turned(a, turn)), test::turned(mip_a, turn)) <
                      1e-5);
        }
    }

    TEST_CASE("mips: any number of threads gives the same bytes") {
        const Cube sky = test::rough_sky(33, 3);
        const auto chain = [&](int threads) {
            const ThreadLimit limit(threads);
            return mip_chain(sky);
        };
        const std::vector<Cube> one = chain(1);
        for (const int threads : {2, 7}) {
            const std::vector<Cube> more = chain(threads);
            for (std::size_t level = 0; level < one.size(); ++level) CHECK(test::same_bytes(one[level], more[level]));
        }
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("mips: a texel of 1e6 in the dark leaves nothing below zero") {
        for (const MipFilter filter : filters)
            for (const int n : {32, 17, 4, 3})
                for (const int at : {0, 1, n / 2, n - 1}) {
                    Cube sky = test::even_sky(n, 1, 0);
                    sky.faces[3].at(at, 0) = 1e6f;
                    for (const Cube& level : mip_chain_by(filter, sky)) CHECK(smallest(level) >= 0);
                }
    }

} // TEST_SUITE
