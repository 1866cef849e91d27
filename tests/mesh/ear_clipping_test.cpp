#include "bake/mesh/ear_clipping.h"
#include <doctest/doctest.h>
#include <random>
#include <set>

namespace {
using namespace bake;
using Points = std::vector<Vec2d>;

Points spiral(int n) {
    Points points;
    for (int i = 0; i < n / 2; ++i) points.emplace_back(std::cos(i * 0.01), std::sin(i * 0.01));
    for (int i = 0; i < n / 2; ++i) points[std::size_t(i)] *= 1 + 20.0 * i / n;
    for (int i = n / 2 - 1; i >= 0; --i) points.push_back(points[std::size_t(i)] * 1.002);
    std::reverse(points.begin(), points.end());
    return points;
}

Points comb(int n) {
    Points points;
    for (int i = n / 4; i > 0; --i)
        for (const Vec2d& p : {Vec2d(0.95, 0), Vec2d(0.6, 100), Vec2d(0.5, 100), Vec2d(0.05, 0)})
            points.push_back(p + Vec2d(i, 0));
    points.emplace_back(0, -1);
    points.emplace_back(n / 4 + 2, -1);
    return points;
}

Points star(int n, double inner) {
    Points points;
    for (int i = 0; i < n; ++i)
        points.push_back((i % 2 ? 1 : inner) * Vec2d(std::cos(2 * pi * i / n), std::sin(2 * pi * i / n)));
    return points;
}

/// A square whose sides have many corners, in a line but for the rounding of floats.
Points many_on_a_side(int n) {
    Points points;
    const Vec2d corners[] = {{0, 0}, {1, 0.5}, {0.5, 1.5}, {-0.5, 1}};
    for (int side = 0; side < 4; ++side)
        for (int i = 0; i < n / 4; ++i)
            points.emplace_back(Vec2f(glm::mix(corners[side], corners[(side + 1) % 4], double(i) / (n / 4))));
    return points;
}

/// Triangles that all have the origin as a corner.
Points petals(int n) {
    Points points;
    for (int i = 0; i < n / 3; ++i) {
        points.emplace_back(0, 0);
        for (const double k : {0.0, 0.5})
            points.emplace_back(std::cos(6 * pi * (i + k) / n), std::sin(6 * pi * (i + k) / n));
    }
    return points;
}

/// A detailed shape that is small beside the rest of the polygon.
Points cluster(int n) {
    Points points = star(n, 0.7);
    for (Vec2d& p : points) p *= 1e-4;
    points.insert(points.end(), {{100, -1}, {100, -100}, {-100, -100}, {-100, 100}, {100, 100}});
    std::rotate(points.begin(), points.end() - 5, points.end());
    return points;
}

Points random_points(int n, unsigned range) {
    std::mt19937 random(11);
    Points points;
    for (int i = 0; i < n; ++i) {
        const double x = double(random() % range);
        points.emplace_back(x, double(random() % range));
    }
    return points;
}

Points round_and_round(int n) {
    Points points;
    const Points one = star(10, 0.4);
    for (int i = 0; i < n; ++i) points.push_back(one[std::size_t(i % 10)]);
    return points;
}

std::vector<EarTriangle> clipped(EarPolygon& polygon, Points points) {
    double area = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) area += signed_area(points[0], points[i], points[i + 1]);
    if (area < 0) std::reverse(points.begin(), points.end());
    polygon.points = std::move(points);
    std::vector<EarTriangle> out(polygon.points.size() - 2);
    clip_ears(polygon, out.data());
    return out;
}

/// Sum of the triangles' areas without sign over that of the polygon: 1 if nothing is covered twice.
double cover(const EarPolygon& polygon, const std::vector<EarTriangle>& triangles) {
    double all = 0, sum = 0;
    for (const EarTriangle& t : triangles) {
        const double area = signed_area(polygon.points[t[0]], polygon.points[t[1]], polygon.points[t[2]]);
        all += std::abs(area);
        sum += area;
    }
    return all / sum;
}
} // namespace

TEST_SUITE("unit") {
    TEST_CASE("IndexSet: the next member is that of std::set") {
        std::mt19937 random(3);
        IndexSet set;
        for (const std::uint32_t count : {1u, 63u, 64u, 65u, 4096u, 4097u, 300000u}) {
            set.reset(count);
            std::set<std::uint32_t> expected;
            CHECK(set.next(0) == no_index);
            for (int step = 0; step < 2000; ++step) {
                const auto i = std::uint32_t(random() % count);
                if (step % 3 < 1 + step / 1000) set.insert(i), expected.insert(i);
                else set.erase(i), expected.erase(i);
                const auto from = std::uint32_t(random() % (count + 1));
                const auto next = expected.lower_bound(from);
                REQUIRE(set.next(from) == (next == expected.end() ? no_index : *next));
            }
        }
    }

    TEST_CASE("CornerTree: finds a corner in a triangle if there is one, until it is removed") {
        std::mt19937 random(4);
        for (const std::uint32_t count : {0u, 1u, 8u, 9u, 500u}) {
            const Points points = random_points(int(count) + 3, 40);
            std::vector<std::uint32_t> left(count);
            for (std::uint32_t i = 0; i < count; ++i) left[i] = i;
            CornerTree tree;
            tree.reset(points, left);
            while (!left.empty()) {
                Vec2d a = points[random() % points.size()], b = points[random() % points.size()];
                const Vec2d c = points[random() % points.size()];
                if (signed_area(a, b, c) < 0) std::swap(a, b);
                const EarRegion region(a, b, c);
                const auto inside = [&](std::uint32_t i) {
                    return points[i] != a && points[i] != c && region.contains(points[i]);
                };
                std::size_t steps = 0;
                const std::uint32_t found = tree.find(region, 7, steps, inside);
                CHECK((found != no_index) == std::any_of(left.begin(), left.end(), inside));
                if (found != no_index) CHECK((inside(found) && std::count(left.begin(), left.end(), found)));
                const std::size_t gone = random() % left.size();
                tree.remove(left[gone]);
                left.erase(left.begin() + std::ptrdiff_t(gone));
            }
        }
    }

    TEST_CASE("clip_ears: polygons of thousands of corners are covered once") {
        EarPolygon polygon;
        for (const Points& points :
             {spiral(4000), comb(4000), star(4000, 0.3), many_on_a_side(4000), petals(3999), cluster(4000)}) {
            const auto triangles = clipped(polygon, points);
            CHECK(cover(polygon, triangles) == doctest::Approx(1).epsilon(1e-6));
        }
    }
} // unit

TEST_SUITE("stability") {
    TEST_CASE("clip_ears: twice the corners take about twice the steps, whatever the polygon") {
        EarPolygon polygon;
        const auto steps = [&](const Points& points) {
            clipped(polygon, points);
            return double(polygon.steps);
        };
        const int n = 6000;
        CHECK(steps(spiral(2 * n)) < 3 * steps(spiral(n)));
        CHECK(steps(comb(2 * n)) < 3 * steps(comb(n)));
        CHECK(steps(star(2 * n, 0.3)) < 3 * steps(star(n, 0.3)));
        CHECK(steps(petals(2 * n)) < 3 * steps(petals(n)));
        CHECK(steps(cluster(2 * n)) < 3 * steps(cluster(n)));
        CHECK(steps(random_points(2 * n, 1000000)) < 3 * steps(random_points(n, 1000000)));
        CHECK(steps(random_points(2 * n, 30)) < 3 * steps(random_points(n, 30)));
        CHECK(steps(round_and_round(2 * n)) < 3 * steps(round_and_round(n)));
        // A limited number for each corner, where all corners lie on four lines or at nine places.
        for (const int many : {n, 8 * n, 16 * n}) {
            CHECK(steps(many_on_a_side(many)) < 400.0 * many);
            CHECK(steps(random_points(many, 3)) < 400.0 * many);
        }
    }
} // stability
