#include "bake/surface/patch/tessellation.h"
#include <cmath>
#include <doctest/doctest.h>
#include <map>

using namespace bake;

namespace {

/// One patch cut up in the plane: where each of its points lies, and its faces.
struct Cut {
    std::vector<Vec2d> places;
    Mesh mesh;
};

Cut cut(PatchRates rates) {
    rates = fitted(rates);
    Cut out;
    const std::vector<Vec2d> corner = rates.sides == 4 ? std::vector<Vec2d>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}
                                                       : std::vector<Vec2d>{{0, 0}, {1, 0}, {0, 1}};
    out.places = corner;
    std::vector<FaceCorner> side[4];
    const auto index = [](std::size_t i) { return FaceCorner{std::uint32_t(i), std::uint32_t(i), std::uint32_t(i)}; };
    PatchRing ring;
    for (int i = 0; i < rates.sides; ++i) {
        const int next = (i + 1) % rates.sides;
        side[i].push_back(index(i));
        for (std::uint32_t k = 1; k < rates.side[i]; ++k) {
            side[i].push_back(index(out.places.size()));
            out.places.push_back(glm::mix(corner[i], corner[next], double(k) / rates.side[i]));
        }
        side[i].push_back(index(next));
        ring.side[i] = side[i];
    }
    const auto inner = std::uint32_t(out.places.size());
    if (inner_points(rates) > 0)
        for (std::uint32_t j = 1; j < rates.up; ++j)
            for (std::uint32_t i = 1; i < (rates.sides == 4 ? rates.across : rates.across - j); ++i)
                out.places.push_back({double(i) / rates.across, double(j) / rates.up});
    CHECK(out.places.size() == inner + inner_points(rates));
    FaceCounter count;
    emit_faces(rates, ring, inner, count);
    out.mesh.face_begin.resize(count.faces + 1);
    out.mesh.corner_position.resize(count.corners);
    out.mesh.corner_normal.resize(count.corners);
    FaceWriter writer(out.mesh, 0, 0);
    emit_faces(rates, ring, inner, writer);
    CHECK(writer.faces() == count.faces);
    CHECK(writer.corners() == count.corners);
    return out;
}

/// Every face turns left, they cover the patch, and each edge inside has two faces, each piece of the border one.
void check_covers(const PatchRates& rates) {
    CAPTURE(rates.sides);
    for (int i = 0; i < 4; ++i) CAPTURE(rates.side[i]);
    CAPTURE(rates.across);
    CAPTURE(rates.up);
    const Cut c = cut(rates);
    double area = 0, smallest = 1;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (std::size_t f = 0; f < c.mesh.faces(); ++f) {
        const std::uint32_t first = c.mesh.face_begin[f], n = c.mesh.face_begin[f + 1] - first;
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t a = c.mesh.corner_position[first + k], b = c.mesh.corner_position[first + (k + 1) % n];
            ++uses[{a, b}];
            const Vec2d &p = c.places[a], &q = c.places[b];
            area += (p.x * q.y - p.y * q.x) / 2;
            if (k + 2 < n) {
                const Vec2d e = q - p, g = c.places[c.mesh.corner_position[first + k + 2]] - p;
                smallest = std::min(smallest, e.x * g.y - e.y * g.x);
            }
        }
    }
    CHECK(area == doctest::Approx(rates.sides == 4 ? 1.0 : 0.5));
    CHECK(smallest > 1e-9);
    std::size_t border = 0;
    bool once = true;
    for (const auto& [edge, count] : uses) {
        once &= count == 1;
        border += !uses.contains({edge.second, edge.first});
    }
    CHECK(once);
    std::size_t segments = 0;
    for (int i = 0; i < rates.sides; ++i) segments += rates.side[i];
    CHECK(border == segments);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("tessellation: any rates of a quad give faces that turn left, cover it and share every edge inside") {
        for (const std::uint32_t a : {1u, 2u, 3u, 7u})
            for (const std::uint32_t b : {1u, 2u, 5u})
                for (const std::uint32_t c : {1u, 2u, 4u})
                    for (const std::uint32_t d : {1u, 2u, 3u})
                        for (const std::uint32_t m : {1u, 2u, 6u})
                            for (const std::uint32_t n : {1u, 2u, 3u}) check_covers({4, {a, b, c, d}, m, n});
    }

    TEST_CASE("tessellation: any rates of a triangle give faces that turn left, cover it and share every edge inside") {
        for (const std::uint32_t a : {1u, 2u, 3u, 7u})
            for (const std::uint32_t b : {1u, 2u, 5u})
                for (const std::uint32_t c : {1u, 2u, 4u})
                    for (const std::uint32_t m : {1u, 2u, 3u, 4u, 8u}) check_covers({3, {a, b, c, 1}, m, m});
    }

    TEST_CASE("tessellation: equal rates give quads on a quad, triangles on a triangle") {
        CHECK(cut({4, {5, 5, 5, 5}, 5, 5}).mesh.corners() == 4 * 25);
        CHECK(cut({4, {5, 3, 5, 3}, 5, 3}).mesh.corners() == 4 * 15);
        CHECK(cut({3, {5, 5, 5, 1}, 5, 5}).mesh.corners() == 3 * 25);
    }

    TEST_CASE("tessellation: sides of one or two segments need no point inside") {
        const Cut c = cut({4, {2, 1, 1, 1}, 1, 1});
        CHECK(c.places.size() == 5);
        CHECK(c.mesh.faces() == 3);
        CHECK(cut({3, {2, 2, 1, 1}, 1, 1}).mesh.faces() == 3);
        CHECK(cut({4, {5, 1, 3, 1}, 1, 1}).places.size() == 4 + 4 + 2);
    }

    TEST_CASE("tessellation: a quad whose side is one point becomes triangles, and one of two points nothing") {
        const auto corner = [](std::uint32_t i) { return FaceCorner{i, i, i}; };
        Mesh mesh;
        mesh.face_begin.resize(2), mesh.corner_position.resize(3), mesh.corner_normal.resize(3);
        FaceCounter count;
        FaceWriter writer(mesh, 0, 0);
        count.quad(corner(7), corner(7), corner(1), corner(2));
        writer.quad(corner(7), corner(7), corner(1), corner(2));
        CHECK(count.faces == 1);
        CHECK(count.corners == 3);
        CHECK(mesh.corner_position == std::vector<std::uint32_t>{7, 1, 2});
        count.quad(corner(7), corner(7), corner(1), corner(1));
        writer.quad(corner(7), corner(7), corner(1), corner(1));
        count.triangle(corner(7), corner(7), corner(1));
        writer.triangle(corner(7), corner(7), corner(1));
        CHECK(count.faces == 1);
        CHECK(writer.faces() == 1);
    }

} // TEST_SUITE
