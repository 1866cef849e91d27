#include "bake/base/parallel.h"
#include "bake/surface/chart/uv_raster.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <doctest/doctest.h>
#include <random>

using namespace bake;

namespace {

struct Chart {
    Mesh mesh;
    std::vector<Triangle> triangles;

    // A face of three corners, or of four, then split at corners 0-2.
    void add(std::initializer_list<Vec2f> uvs) {
        const std::uint32_t begin = std::uint32_t(mesh.corners()), face = std::uint32_t(mesh.faces());
        for (const Vec2f& uv : uvs) {
            mesh.corner_uv.push_back(std::uint32_t(mesh.uvs.size()));
            mesh.corner_position.push_back(std::uint32_t(mesh.uvs.size()));
            mesh.uvs.push_back(uv);
            mesh.positions.emplace_back(uv, 0);
        }
        mesh.face_begin.push_back(begin + std::uint32_t(uvs.size()));
        for (std::uint32_t k = 2; k < uvs.size(); ++k) triangles.push_back({{begin, begin + k - 1, begin + k}, face});
    }
    UvRaster raster(int width, int height) const { return uv_raster(mesh, triangles, width, height); }
    Vec2d uv(std::uint32_t triangle, int corner) const {
        return Vec2d(mesh.uvs[mesh.corner_uv[triangles[triangle].corner[corner]]]);
    }
    Vec2d at(const TexelHit& hit) const {
        const Vec2d a = uv(hit.triangle, 0);
        return a + double(hit.b1) * (uv(hit.triangle, 1) - a) + double(hit.b2) * (uv(hit.triangle, 2) - a);
    }
};

Vec2d centre(const UvRaster& raster, int x, int y) {
    return {(x + 0.5) / raster.hits.width(), 1 - (y + 0.5) / raster.hits.height()};
}

double turn(const Vec2d& a, const Vec2d& b, const Vec2d& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// +1 inside, 0 on the boundary, -1 outside.
int place(const Chart& chart, std::uint32_t t, const Vec2d& p) {
    const Vec2d a = chart.uv(t, 0), b = chart.uv(t, 1), c = chart.uv(t, 2);
    const double s = turn(a, b, c) < 0 ? -1 : 1;
    const double least = std::min({s * turn(a, b, p), s * turn(b, c, p), s * turn(c, a, p)});
    return least > 0 ? 1 : least < 0 ? -1 : 0;
}

bool segments_meet(const Vec2d& a, const Vec2d& b, const Vec2d& p, const Vec2d& q) {
    const auto sign = [](double x) { return (x > 0) - (x < 0); };
    const auto within = [](const Vec2d& u, const Vec2d& v, const Vec2d& w) {
        return std::min(u.x, v.x) <= w.x && w.x <= std::max(u.x, v.x) && std::min(u.y, v.y) <= w.y &&
               w.y <= std::max(u.y, v.y);
    };
    const int s1 = sign(turn(a, b, p)), s2 = sign(turn(a, b, q)), s3 = sign(turn(p, q, a)), s4 = sign(turn(p, q, b));
    if (s1 * s2 < 0 && s3 * s4 < 0) return true;
    return (s1 == 0 && within(a, b, p)) || (s2 == 0 && within(a, b, q)) || (s3 == 0 && within(p, q, a)) ||
           (s4 == 0 && within(p, q, b));
}

// The closed texel square meets the closed triangle.
bool touches(const Chart& chart, std::uint32_t t, const Vec2d& c, const Vec2d& half) {
    const Vec2d square[4] = {c + half * Vec2d(-1, -1), c + half * Vec2d(1, -1), c + half, c + half * Vec2d(-1, 1)};
    for (int k = 0; k < 4; ++k) {
        if (place(chart, t, square[k]) >= 0) return true;
        for (int e = 0; e < 3; ++e)
            if (segments_meet(chart.uv(t, e), chart.uv(t, (e + 1) % 3), square[k], square[(k + 1) % 4])) return true;
    }
    const Vec2d v = chart.uv(t, 0) - c; // a triangle that lies in the square
    return std::abs(v.x) <= half.x && std::abs(v.y) <= half.y;
}

// In texels, to a triangle that does not hold p.
double distance(const Chart& chart, std::uint32_t t, const Vec2d& p, const Vec2d& size) {
    double best = HUGE_VAL;
    for (int e = 0; e < 3; ++e) {
        const Vec2d a = (chart.uv(t, e) - p) * size, d = (chart.uv(t, (e + 1) % 3) - p) * size - a;
        const double along = std::min(1.0, std::max(0.0, -glm::dot(a, d) / glm::dot(d, d)));
        best = std::min(best, glm::length(a + along * d));
    }
    return best;
}

struct Expected {
    std::int64_t covered = 0, border = 0, overlapped = 0, wrong_winner = 0, wrong_border = 0, off_centre = 0;
};

// Every texel against every triangle.
Expected brute(const Chart& chart, const UvRaster& raster) {
    Expected out;
    const int w = raster.hits.width(), h = raster.hits.height();
    const Vec2d half(0.5 / w, 0.5 / h), size(w, h);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const Vec2d c = centre(raster, x, y);
            const TexelHit hit = raster.hits.at(x, y);
            std::uint32_t winner = no_index, last_face = no_index;
            int faces = 0;
            for (std::uint32_t t = 0; t < chart.triangles.size(); ++t) {
                const int where = place(chart, t, c);
                if (where >= 0 && winner == no_index) winner = t;
                if (where > 0 && chart.triangles[t].face != last_face) ++faces, last_face = chart.triangles[t].face;
            }
            out.overlapped += faces > 1;
            if (winner != no_index) {
                ++out.covered;
                out.wrong_winner += hit.triangle != winner;
                if (hit.triangle != no_index) out.off_centre += glm::length((chart.at(hit) - c) * size) > 1e-4;
                continue;
            }
            double best = HUGE_VAL;
            for (std::uint32_t t = 0; t < chart.triangles.size(); ++t) {
                if (!touches(chart, t, c, half)) continue;
                const double d = distance(chart, t, c, size);
                if (d < best - 1e-9) best = d, winner = t;
            }
            out.border += winner != no_index;
            out.wrong_border += hit.triangle != winner;
            if (winner != no_index && hit.triangle == winner)
                out.off_centre += std::abs(glm::length((chart.at(hit) - c) * size) - best) > 1e-4;
        }
    return out;
}

// Triangles and quads; on a lattice of 1/`lattice`, so that centres and corners fall on edges, or anywhere (0).
Chart soup(int faces, float spread, int lattice, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> anywhere(-0.1f, 1.1f), near(-spread, spread);
    const auto snap = [&](const Vec2f& p) {
        const float n = float(lattice);
        return lattice ? Vec2f(std::round(p.x * n) / n, std::round(p.y * n) / n) : p;
    };
    Chart chart;
    while (faces > 0) {
        const Vec2f c(anywhere(random), anywhere(random));
        const auto point = [&] { return snap(c + Vec2f(near(random), near(random))); };
        const Vec2f p[4] = {point(), point(), point(), point()};
        if (turn(p[0], p[1], p[2]) == 0 || turn(p[0], p[2], p[3]) == 0) continue;
        if (faces % 3 == 0) chart.add({p[0], p[1], p[2], p[3]});
        else chart.add({p[0], p[1], p[2]});
        --faces;
    }
    return chart;
}

Chart unit_square() {
    Chart chart;
    chart.add({{0, 0}, {1, 0}, {1, 1}});
    chart.add({{0, 0}, {1, 1}, {0, 1}});
    return chart;
}

bool finite_inside(const UvRaster& raster) {
    for (std::size_t k = 0; k < raster.hits.size(); ++k) {
        const TexelHit& hit = raster.hits.data()[k];
        if (!(hit.b1 >= 0 && hit.b2 >= 0 && hit.b1 + hit.b2 <= 1.00001f)) return false;
    }
    return true;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE(
        "uv_raster: two triangles fill the unit square once, and their barycentrics give back the texel's centre") {
        for (const auto& [w, h] : {std::pair(64, 64), {37, 91}, {1, 1}, {1, 50}, {50, 1}, {2, 3}, {333, 200}}) {
            const Chart chart = unit_square();
            const UvRaster raster = chart.raster(w, h);
            CHECK(raster.covered == std::int64_t(w) * h);
            CHECK(raster.border == 0);
            CHECK(raster.overlapped == 0);
            CHECK(raster.outside_faces == 0);
            CHECK(raster.crossing_faces == 0);
            CHECK(raster.degenerate == 0);
            double worst = 0;
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x)
                    worst = std::max(worst, glm::length(chart.at(raster.hits.at(x, y)) - centre(raster, x, y)));
            CHECK(worst < 1e-6); // float barycentrics
        }
    }

    TEST_CASE("uv_raster: the upper left texel is at u = 0, v = 1") {
        Chart chart;
        chart.add({{0, 0.75f}, {0.25f, 0.75f}, {0.25f, 1}, {0, 1}});
        const UvRaster raster = chart.raster(4, 4);
        CHECK(raster.covered == 1);
        CHECK(raster.hits.at(0, 0).triangle == 0);
        CHECK(raster.border == 3); // the squares beside it touch its sides
        CHECK(raster.hits.at(2, 0).triangle == no_index);
    }

    TEST_CASE("uv_raster: a centre on a shared edge is the lower face's and no overlap, whichever way the faces run") {
        for (const bool mirrored : {false, true})
            for (const int way : {0, 1, 2, 3}) {
                const bool swapped = way & 1, turned = way & 2;
                Chart chart; // the edge at u = 1/2, or v, runs through the centres of the middle column, or row
                const auto left = [&] { chart.add({{0, 0}, {0.5f, 0}, {0.5f, 1}, {0, 1}}); };
                const auto right = [&] { chart.add({{0.5f, 0}, {1, 0}, {1, 1}, {0.5f, 1}}); };
                swapped ? (right(), left()) : (left(), right());
                if (mirrored)
                    for (Vec2f& uv : chart.mesh.uvs) uv.x = 1 - uv.x;
                if (turned)
                    for (Vec2f& uv : chart.mesh.uvs) std::swap(uv.x, uv.y);
                const UvRaster raster = chart.raster(3, 3);
                CHECK(raster.covered == 9);
                CHECK(raster.overlapped == 0);
                for (int k = 0; k < 3; ++k) {
                    const TexelHit& hit = turned ? raster.hits.at(k, 1) : raster.hits.at(1, k);
                    CHECK(chart.triangles[hit.triangle].face == 0);
                }
                // Each centre, those on the edge too, has one owner: a second copy overlaps everywhere.
                for (const Triangle& t : std::vector(chart.triangles))
                    chart.triangles.push_back({t.corner, t.face + 2});
                chart.mesh.face_begin = {0, 4, 8, 8, 8};
                CHECK(chart.raster(3, 3).overlapped == 9);
            }
    }

    TEST_CASE("uv_raster: fans around any point have no gap and no overlap") {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> place_in(0.01f, 0.99f);
        for (int round = 0; round < 40; ++round) {
            std::vector<Vec2f> rim = {{0, 0}};
            const Vec2f corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            for (int side = 0; side < 4; ++side) {
                const Vec2f a = corners[side], b = corners[(side + 1) % 4];
                float along = 0;
                for (int k = 0; k < 9; ++k) {
                    along += (1 - along) * 0.3f * place_in(random);
                    rim.push_back(a + along * (b - a));
                }
                rim.push_back(b);
            }
            const Vec2f hub(place_in(random), place_in(random));
            Chart chart;
            for (std::size_t k = 0; k + 1 < rim.size(); ++k) chart.add({hub, rim[k], rim[k + 1]});
            const int size = 20 + round;
            const UvRaster raster = chart.raster(size, 3 * size / 2);
            CHECK(raster.covered == std::int64_t(size) * (3 * size / 2));
            CHECK(raster.overlapped == 0);
        }
    }

    TEST_CASE("uv_raster: mirrored triangles cover the same texels at the same points") {
        Chart chart = soup(40, 0.2f, 0, 11), mirrored = chart;
        for (Triangle& t : mirrored.triangles) std::swap(t.corner[1], t.corner[2]);
        const UvRaster a = chart.raster(50, 40), b = mirrored.raster(50, 40);
        CHECK(a.covered == b.covered);
        CHECK(a.border == b.border);
        CHECK(a.overlapped == b.overlapped);
        double worst = 0;
        for (std::size_t k = 0; k < a.hits.size(); ++k) {
            const TexelHit &h = a.hits.data()[k], &m = b.hits.data()[k];
            REQUIRE(h.triangle == m.triangle);
            worst = std::max({worst, std::abs(double(h.b1) - m.b2), std::abs(double(h.b2) - m.b1)});
        }
        CHECK(worst < 1e-6);
    }

    TEST_CASE("uv_raster: overlap counts texels of two faces, not of the two triangles of one") {
        Chart twice = unit_square();
        twice.add({{0, 0}, {0.5f, 0}, {0.5f, 1}, {0, 1}});
        CHECK(twice.raster(8, 8).overlapped == 32);
        CHECK(twice.raster(8, 8).covered == 64);

        Chart bow; // corner 3 is folded over the diagonal 0-2
        bow.add({{0, 0}, {1, 0}, {1, 1}, {0.9f, 0.1f}});
        CHECK(bow.raster(32, 32).overlapped == 0);
        bow.triangles[1].face = 1;
        bow.mesh.face_begin = {0, 3, 4};
        CHECK(bow.raster(32, 32).overlapped > 100);
    }

    TEST_CASE("uv_raster: faces outside, crossing and without area are counted, those off the chart left out") {
        Chart chart = unit_square();
        chart.add({{1.5f, 0}, {2.5f, 0}, {2, 1}});             // outside
        chart.add({{-0.5f, 0.8f}, {0.8f, 2.1f}, {-0.5f, 2}});  // outside, though its box is not
        chart.add({{-1, -1}, {0.3f, 0.3f}, {-1, 0}});          // crossing
        chart.add({{1, 1}, {2, 1}, {2, 2}});                   // crossing: a corner touches
        chart.add({{-9, -9}, {19, -9}, {0, 19}});              // crossing: holds the square
        chart.add({{0.1f, 0.1f}, {0.5f, 0.5f}, {0.9f, 0.9f}}); // no area
        chart.add({{0.2f, 0.2f}, {0.2f, 0.2f}, {0.7f, 0.9f}}); // no area
        const UvRaster raster = chart.raster(16, 16);
        CHECK(raster.covered == 256);
        CHECK(raster.border == 0);
        CHECK(raster.outside_faces == 2);
        CHECK(raster.crossing_faces == 3);
        CHECK(raster.degenerate == 2);
        CHECK(raster.overlapped == 256);

        Chart thin;
        thin.add({{0.1f, 0.1f}, {0.5f, 0.5f}, {0.9f, 0.9f}});
        CHECK(thin.raster(16, 16).border == 0);

        Chart holed = unit_square();
        holed.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        holed.mesh.corner_uv[9] = no_index; // of the quad: both its triangles go
        holed.mesh.corner_uv[0] = no_index;
        const UvRaster half = holed.raster(16, 16);
        CHECK(half.covered == 136); // the upper triangle with its diagonal
        CHECK(half.overlapped == 0);
        holed.mesh.corner_uv.clear();
        CHECK(holed.raster(16, 16).covered == 0);
        CHECK(holed.raster(16, 16).hits.at(3, 3).triangle == no_index);
    }

    /// Rows of all bands.
    Image<TexelHit> places(const Chart& chart, int width, int height, const Vec2d& place) {
        const PlaceRaster raster(chart.mesh, chart.triangles, width, height);
        Image<TexelHit> out(width, height, 1);
        for (int b = 0; b < raster.bands(); ++b) {
            const int y = b * PlaceRaster::band_rows, rows = std::min(PlaceRaster::band_rows, height - y);
            raster.band(b, place, {out.row(y), std::size_t(rows) * std::size_t(width)});
        }
        return out;
    }

    TEST_CASE("uv_raster: another place in each texel is the centre of the quarter of the texel around it") {
        const Chart chart = soup(40, 0.2f, 0, 17);
        const Image<TexelHit> quarters = places(chart, 96, 72, {0.5, 0.5});
        std::int64_t covered = 0;
        for (const auto& [i, j] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
            const Image<TexelHit> raster = places(chart, 48, 36, {0.25 + 0.5 * i, 0.25 + 0.5 * j});
            int differ = 0;
            for (int y = 0; y < 36; ++y)
                for (int x = 0; x < 48; ++x) {
                    const TexelHit &a = raster.at(x, y), &b = quarters.at(2 * x + i, 2 * y + j);
                    covered += a.triangle != no_index;
                    differ +=
                        a.triangle != b.triangle || std::abs(a.b1 - b.b1) > 1e-5f || std::abs(a.b2 - b.b2) > 1e-5f;
                }
            CHECK(differ == 0);
        }
        CHECK(covered > 1000);
    }

    TEST_CASE("uv_raster: of places, texels whose place lies in no triangle stay empty and the others are the same") {
        const Chart chart = soup(40, 0.1f, 0, 23);
        const UvRaster with = chart.raster(48, 36);
        const Image<TexelHit> without = places(chart, 48, 36, {0.5, 0.5});
        CHECK(with.border > 50);
        std::int64_t filled = 0, differ = 0;
        for (std::size_t k = 0; k < with.hits.size(); ++k) {
            const TexelHit &a = with.hits.data()[k], &b = without.data()[k];
            if (b.triangle != no_index) ++filled, differ += a.triangle != b.triangle || a.b1 != b.b1 || a.b2 != b.b2;
        }
        CHECK(filled == with.covered);
        CHECK(differ == 0);
    }
}

TEST_SUITE("oracle") {
    TEST_CASE("uv_raster: every texel of a soup agrees with a test against every triangle") {
        // Spread in units of uv; on the lattice, edges run through centres and along texel sides.
        for (const float spread : {0.02f, 0.1f, 0.6f})
            for (const int lattice : {0, 64, 128})
                for (const auto& [width, height] : {std::pair(32, 32), {64, 16}, {1, 32}, {32, 64}}) {
                    const int w = width, h = height;
                    const Chart chart = soup(30, spread, lattice, unsigned(w * 7 + h + lattice));
                    const UvRaster raster = chart.raster(w, h);
                    const Expected expected = brute(chart, raster);
                    INFO("spread " << spread << ", lattice " << lattice << ", " << w << " x " << h);
                    CHECK(raster.covered == expected.covered);
                    CHECK(raster.border == expected.border);
                    // On the lattice, a centre on the edges of two faces may count as both's.
                    if (lattice) CHECK(raster.overlapped >= expected.overlapped);
                    else CHECK(raster.overlapped == expected.overlapped);
                    CHECK(expected.wrong_winner == 0);
                    CHECK(expected.wrong_border == 0);
                    CHECK(expected.off_centre == 0);
                }
    }
}

TEST_SUITE("stability") {
    TEST_CASE("uv_raster: nothing to draw, and nothing to draw on") {
        const UvRaster none = Chart{}.raster(5, 4);
        CHECK(none.covered == 0);
        CHECK(none.hits.at(4, 3).triangle == no_index);
        CHECK(unit_square().raster(0, 4).hits.empty());
    }

    TEST_CASE("uv_raster: uvs of any size neither overflow nor lose the texels they cover") {
        for (const float far : {3.0f, 1e3f, 1e6f, 1e9f, 1e20f, 3e38f}) {
            INFO("uvs up to " << far);
            Chart chart; // one holds the square, the other a wedge of it from v = 0.375 to 0.5
            chart.add({{-far, -far}, {far, -far}, {0, far}});
            chart.add({{far, 0.25f}, {far, 0.5f}, {-far, 0.5f}});
            const UvRaster raster = chart.raster(64, 64);
            CHECK(raster.crossing_faces == 2);
            CHECK(raster.covered == 64 * 64);
            if (far > 100) CHECK(raster.overlapped == 8 * 64);
            CHECK(finite_inside(raster));
        }
        Chart tiny; // a triangle smaller than a texel's ten-thousandth
        tiny.add({{0.5f, 0.5f}, {0.500001f, 0.5f}, {0.5f, 0.500001f}});
        const UvRaster raster = tiny.raster(31, 31);
        CHECK(raster.degenerate == 0);
        CHECK(raster.covered + raster.border == 1);
        CHECK(finite_inside(raster));
    }

    TEST_CASE("uv_raster: the number of threads does not change a bit") {
        const Chart chart = soup(3000, 0.05f, 0, 5);
        UvRaster one;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            UvRaster raster = chart.raster(300, 500);
            if (threads == 1) one = std::move(raster);
            const UvRaster& other = threads == 1 ? one : raster;
            CHECK(std::memcmp(one.hits.data(), other.hits.data(), one.hits.size() * sizeof(TexelHit)) == 0);
            CHECK(one.covered == other.covered);
            CHECK(one.border == other.border);
            CHECK(one.overlapped == other.overlapped);
        }
    }
}
