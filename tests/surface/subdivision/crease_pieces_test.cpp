// Patches along semi-sharp creases, in pieces, compared with the refinement of the faces along the crease.
#include "bake/surface/subdivision/subdivision.h"
#include "oracle/surfaces.h"
#include "surface/subdivision/cages.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake_tests;

namespace {

/// A sheet with creases along the line j = 2 (along u) and, if `crossing`, i = 3; its uvs are not affine in the positions.
Mesh creased_sheet(float sharpness, bool crossing) {
    Mesh cage = sheet(6, [](int i, int j) { return 0.3 * std::sin(1.7 * i + 0.4 * j) + 0.5 * std::abs(j - 2); });
    const auto at = [](int i, int j) { return std::uint32_t(j * 7 + i); };
    for (int i = 0; i < 6; ++i) cage.tags.creases.push_back({at(i, 2), at(i + 1, 2), sharpness});
    for (int j = 0; crossing && j < 6; ++j) cage.tags.creases.push_back({at(3, j), at(3, j + 1), 0.7f * sharpness});
    for (Vec2f& uv : cage.uvs) uv += Vec2f(0.1f * uv.y * uv.y, 0.2f * uv.x * uv.y);
    return cage;
}

/// Gives the faces with i >= first or j >= first another chart.
void cut_uvs(Mesh& cage, bool along_crease) {
    const auto count = std::uint32_t(cage.uvs.size());
    for (std::uint32_t k = 0; k < count; ++k) cage.uvs.push_back(cage.uvs[k] + Vec2f(2, 0.1f * float(k % 3)));
    for (std::uint32_t f = 0; f < cage.faces(); ++f)
        if (along_crease ? f / 6 >= 2 : f % 6 >= 2)
            for (std::uint32_t c = 4 * f; c < 4 * f + 4; ++c) cage.corner_uv[c] += count;
}

/// Edges next to each other differ in the last bits of their sharpness, which OpenSubdiv refines.
Mesh refined(Mesh cage) {
    for (std::size_t k = 0; k < cage.tags.creases.size(); ++k)
        for (std::size_t n = k % 3; n > 0; --n)
            cage.tags.creases[k].sharpness = std::nextafter(cage.tags.creases[k].sharpness, 0.0f);
    return cage;
}

struct Difference {
    double p = 0, normal = 0, uv = 0, second = 0;
};

Difference difference(const SubdivisionSurface& a, const SubdivisionSurface& b) {
    REQUIRE(a.patches() == b.patches());
    Difference worst;
    for (std::uint32_t patch = 0; patch < a.patches(); ++patch) {
        const int rate = 31; // no multiple of a power of two: no point lies on the border of a piece
        std::vector<LimitPoint> p(std::size_t((rate + 1) * (rate + 1))), q(p.size());
        a.evaluate_lattice(patch, rate, Derivatives::second, p);
        b.evaluate_lattice(patch, rate, Derivatives::second, q);
        for (std::size_t i = 0; i < p.size(); ++i) {
            worst.p = std::max(worst.p, glm::distance(p[i].p, q[i].p));
            worst.uv = std::max(worst.uv, glm::distance(p[i].uv, q[i].uv));
            worst.normal = std::max(worst.normal,
                                    oracle::angle_deg(glm::cross(p[i].p_s, p[i].p_t), glm::cross(q[i].p_s, q[i].p_t)));
            worst.second =
                std::max({worst.second, glm::distance(p[i].p_ss, q[i].p_ss), glm::distance(p[i].p_tt, q[i].p_tt)});
        }
    }
    return worst;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("SubdivisionSurface: pieces along semi-sharp creases are the refined surface, uvs too") {
        for (const float sharpness : {0.4f, 1.0f, 1.5f, 2.0f, 3.7f, 5.2f})
            for (const bool crossing : {false, true})
                for (const UvSmoothing uv : {UvSmoothing::inside, UvSmoothing::all, UvSmoothing::none})
                    for (const int seam : {0, 1, 2}) {
                        Mesh cage = creased_sheet(sharpness, crossing);
                        if (seam > 0) cut_uvs(cage, seam == 2);
                        const SubdivisionSurface pieces(cage, {Scheme::catmark, uv}),
                            faces(refined(cage), {Scheme::catmark, uv});
                        const Difference d = difference(pieces, faces);
                        CAPTURE(sharpness);
                        CAPTURE(crossing);
                        CAPTURE(int(uv));
                        CAPTURE(seam);
                        CHECK(d.p < 1e-6);
                        CHECK(d.normal < 1e-3);
                        CHECK(d.uv < 1e-6);
                    }
    }

    TEST_CASE("SubdivisionSurface: points and rows of a creased patch have equal bits, and its parts fit together") {
        const SubdivisionSurface surface(creased_sheet(3.7f, true));
        const int rate = 24;
        for (std::uint32_t patch = 0; patch < surface.patches(); ++patch) {
            std::vector<LimitPoint> rows(std::size_t((rate + 1) * (rate + 1))), points(rows.size());
            std::vector<Vec2d> st;
            for (int j = 0; j <= rate; ++j)
                for (int i = 0; i <= rate; ++i) st.emplace_back(i / double(rate), j / double(rate));
            surface.evaluate_lattice(patch, rate, Derivatives::first, rows);
            surface.evaluate(patch, st, Derivatives::first, points);
            for (std::size_t i = 0; i < rows.size(); ++i) {
                CHECK(rows[i].p == points[i].p);
                CHECK(rows[i].p_s == points[i].p_s);
                CHECK(rows[i].uv == points[i].uv);
            }
            // Across the borders of the pieces, which are at 1 - 2^-n from the crease.
            for (int n = 1; n < 7; ++n)
                for (const double line : {std::exp2(-n), 1 - std::exp2(-n)})
                    for (const bool along_s : {false, true}) {
                        const auto at = [&](double x) { return along_s ? Vec2d(0.3, x) : Vec2d(x, 0.3); };
                        const Vec2d two[2] = {at(line - 1e-12), at(line + 1e-12)};
                        LimitPoint p[2];
                        surface.evaluate(patch, two, Derivatives::first, p);
                        CHECK(glm::distance(p[0].p, p[1].p) < 1e-10);
                        CHECK(glm::distance(p[0].p_s, p[1].p_s) < 1e-8);
                        CHECK(glm::distance(p[0].p_t, p[1].p_t) < 1e-8);
                    }
        }
    }
}

TEST_SUITE("stability") {
    TEST_CASE("SubdivisionSurface: thousands of sharp creases need no refinement along them") {
        // Refined to the level of the sharpness, these creases need some gigabytes.
        const int n = 72;
        Mesh cage = sheet(n, [](int i, int j) { return 0.2 * (i % 3) + 0.1 * (j % 2); });
        const auto at = [](int i, int j) { return std::uint32_t(j * (n + 1) + i); };
        for (int j = 2; j < n; j += 3)
            for (int i = 0; i < n; ++i) cage.tags.creases.push_back({at(i, j), at(i + 1, j), 9.3f});
        const SubdivisionSurface surface(cage);
        CHECK(surface.patches() == std::uint32_t(n * n));
    }
}
