// Small meshes, the complexes of base surfaces, and the points of their patches.
#pragma once
#include "bake/surface/patch/base_surface.h"
#include <doctest/doctest.h>
#include <map>
#include <optional>

namespace bake::test {

/// Faces over the given positions.
inline Mesh polygons(std::vector<Vec3f> positions, const std::vector<std::vector<std::uint32_t>>& faces) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    for (const auto& face : faces) {
        mesh.corner_position.insert(mesh.corner_position.end(), face.begin(), face.end());
        mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
    }
    return mesh;
}

inline Mesh unit_cube() {
    return polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// A Moebius strip of `count` quads, wound along itself: at its closing edge the faces run the same way.
inline Mesh moebius(int count) {
    std::vector<Vec3f> positions;
    std::vector<std::vector<std::uint32_t>> faces;
    for (int i = 0; i < count; ++i) {
        const double u = 2 * pi * i / count;
        for (const double side : {-0.3, 0.3}) {
            const double ring = 1 + side * std::cos(u / 2);
            positions.emplace_back(ring * std::cos(u), ring * std::sin(u), side * std::sin(u / 2));
        }
        const auto a = std::uint32_t(2 * i), b = std::uint32_t(2 * ((i + 1) % count));
        if (i + 1 < count) faces.push_back({a, b, b + 1, a + 1});
        else faces.push_back({a, 1, 0, a + 1});
    }
    return polygons(positions, faces);
}

/// Every side leads from its edge's one end to the other, as `reversed` says; every number is used.
inline void check_consistent(const PatchComplex& complex) {
    std::vector<std::array<std::uint32_t, 2>> ends(complex.edges, {no_index, no_index});
    std::vector<bool> vertex_used(complex.vertices, false);
    bool well = true;
    for (const auto& patch : complex.patches)
        for (int k = 0; k < patch.sides(); ++k) {
            const std::uint32_t from = patch.vertex[k], to = patch.vertex[(k + 1) % patch.sides()];
            REQUIRE(from < complex.vertices);
            REQUIRE(patch.edge[k] < complex.edges);
            vertex_used[from] = true;
            const std::array<std::uint32_t, 2> run = patch.reversed[k] ? std::array{to, from} : std::array{from, to};
            auto& known = ends[patch.edge[k]];
            if (known[0] == no_index) known = run;
            well &= known == run;
        }
    CHECK(well);
    CHECK(std::count(vertex_used.begin(), vertex_used.end(), false) == 0);
    for (const auto& e : ends) well &= e[0] != no_index;
    CHECK(well);
    CHECK(complex.seam.size() == complex.edges);
    CHECK(complex.crease.size() == complex.edges);
    CHECK(complex.sharp_vertex.size() == complex.vertices);
    // No two edges join the same two vertices, those without length aside.
    std::map<std::array<std::uint32_t, 2>, int> joined;
    for (const auto& e : ends)
        if (e[0] != e[1]) well &= ++joined[e] == 1;
    CHECK(well);
}

/// Faces and vertices less edges; an edge without length takes the face's corner with it.
inline int euler(const PatchComplex& complex) {
    int poles = 0;
    for (const auto& patch : complex.patches)
        for (int k = 0; k < patch.sides(); ++k) poles += patch.vertex[k] == patch.vertex[(k + 1) % patch.sides()];
    return int(complex.patches.size()) + int(complex.vertices) - (int(complex.edges) - poles);
}

inline int boundary_edges(const PatchComplex& complex) {
    std::vector<int> count(complex.edges, 0);
    for (const auto& patch : complex.patches)
        for (int k = 0; k < patch.sides(); ++k) ++count[patch.edge[k]];
    return int(std::count(count.begin(), count.end(), 1));
}

inline SurfacePoint at(const BaseSurface& base, std::uint32_t patch, double s, double t) {
    SurfacePoint point;
    const Vec2d st(s, t);
    base.evaluate(patch, {&st, 1}, {&point, 1});
    return point;
}

/// Parameters of a place `along` side k of a patch.
inline Vec2d on_side(const PatchComplex::Patch& patch, int k, double along) {
    static const Vec2d quad[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle[] = {{0, 0}, {1, 0}, {0, 1}};
    const Vec2d* corner = patch.sides() == 4 ? quad : triangle;
    return (1 - along) * corner[k] + along * corner[(k + 1) % patch.sides()];
}

/// The largest distance of what the patches at an edge say of its points; of normals and uvs too where nothing splits them.
struct Disagreement {
    double p = 0, n = 0, uv = 0;
};
inline Disagreement edge_disagreement(const BaseSurface& base,
                                      std::initializer_list<double> places = {0.0, 0.25, 0.5, 1.0}) {
    const PatchComplex& complex = base.complex();
    Disagreement worst;
    for (const double place : places) {
        std::vector<std::optional<SurfacePoint>> first(complex.edges);
        for (std::uint32_t i = 0; i < complex.patches.size(); ++i)
            for (int k = 0; k < complex.patches[i].sides(); ++k) {
                const auto& patch = complex.patches[i];
                const Vec2d st = on_side(patch, k, patch.reversed[k] ? 1 - place : place);
                const SurfacePoint point = at(base, i, st.x, st.y);
                auto& other = first[patch.edge[k]];
                if (!other) other = point;
                worst.p = std::max(worst.p, glm::length(point.jet.p - other->jet.p));
                if (!complex.crease[patch.edge[k]] && point.jet.n != Vec3d(0) && other->jet.n != Vec3d(0))
                    worst.n = std::max(worst.n, glm::length(point.jet.n - other->jet.n));
                if (!complex.seam[patch.edge[k]]) worst.uv = std::max(worst.uv, glm::length(point.uv - other->uv));
            }
    }
    return worst;
}

} // namespace bake::test
