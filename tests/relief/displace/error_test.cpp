#include "bake/relief/displace/error.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;

TEST_SUITE("oracle") {

    TEST_CASE(
        "distance_to_triangle: that of the face, an edge or a corner, whichever is nearest, at any size and place") {
        struct Known {
            Vec3d p;
            double distance;
        };
        // Over the right triangle of sides 3, 4 and 5: inside, beside each edge, beyond each corner, and on it.
        const Known known[] = {
            {{1, 1, 7}, 7},   {{1, 1, -2}, 2},       {{1, -3, 4}, 5},          {{2, -5, 0}, 5},
            {{-3, 1, 4}, 5},  {{-6, 2, 0}, 6},       {{2 + 3, 1.5 + 4, 0}, 5}, {{2 + 0.6, 1.5 + 0.8, 0}, 1},
            {{-3, -4, 0}, 5}, {{4 + 3, -4, 12}, 13}, {{-4, 3 + 3, 12}, 13},    {{0, 0, 0}, 0},
            {{4, 0, 0}, 0},   {{0, 3, 0}, 0},        {{2, 1.5, 0}, 0},         {{1, 0, 0}, 0}};
        const Vec3d corner[3] = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
        for (const double size : {1e-3, 1.0, 1e3})
            for (int first = 0; first < 3; ++first)
                for (const bool turned : {false, true}) {
                    const auto at = [&](const Vec3d& p) { return size * (p + Vec3d(5, -2, 1)); };
                    const Vec3d a = at(corner[first]), b = at(corner[(first + (turned ? 2 : 1)) % 3]),
                                c = at(corner[(first + (turned ? 1 : 2)) % 3]);
                    for (const Known& k : known)
                        CHECK(std::abs(distance_to_triangle(at(k.p), a, b, c) - size * k.distance) < 1e-12 * size);
                }
    }

    TEST_CASE("distance_to_triangle: that of the plane over the face, else that of the nearest edge, on any triangle") {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> coordinate(-1, 1);
        const auto anywhere = [&] { return Vec3d(coordinate(random), coordinate(random), coordinate(random)); };
        int over = 0;
        for (int i = 0; i < 20000; ++i) {
            const Vec3d a = anywhere(), b = anywhere(), c = anywhere(), p = anywhere();
            const Vec3d normal = glm::normalize(glm::cross(b - a, c - a));
            const auto left_of = [&](const Vec3d& from, const Vec3d& to) {
                return glm::dot(glm::cross(to - from, p - from), normal) >= 0;
            };
            const bool inside = left_of(a, b) && left_of(b, c) && left_of(c, a);
            const double expected = inside ? std::abs(glm::dot(p - a, normal))
                                           : std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c),
                                                       distance_to_segment(p, c, a)});
            over += inside;
            if (std::abs(distance_to_triangle(p, a, b, c) - expected) > 1e-9) FAIL_CHECK(i);
        }
        CHECK(over > 1000);
    }
}

TEST_SUITE("unit") {

    TEST_CASE("cell_error: a face is compared with the surface in its middle and in the middle of each side") {
        // A face from texel centre to texel centre, two texels wide, under a height that is 0 but in one of nine texels.
        const float low = 1.5f / 5, high = 3.5f / 5;
        const BaseSurface base(test::polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}},
                                              {{low, low}, {high, low}, {high, high}, {low, high}}));
        DisplaceOptions options = test::levels(0);
        options.measure_error = true;
        for (const auto& [x, y] : {std::pair(2, 2), {1, 2}, {3, 2}, {2, 1}, {2, 3}}) {
            CAPTURE(x);
            CAPTURE(y);
            Image<float> values = test::picture(5, 5, [](double, double) { return 0; });
            values.at(x, y) = 1;
            const Displaced out = displace(base, test::relief(std::move(values), 0.1, 0), options);
            CHECK(out.report.error_max == doctest::Approx(0.1).epsilon(1e-4));
        }
    }
}
