// Exact audits of a mesh by CGAL, for cases in which floating-point tests are wrong.
//
// The search for self intersections and the test of orientation complement each other: a sphere turned inside out has no
// self intersections, and two intersecting spheres are both oriented outwards. Neither detects a torus displaced by -2 r,
// which is a valid torus again; only the local test of the displacement detects it.
#pragma once
#include "bake/mesh/triangulate.h"

namespace bake {

/// Results for a triangle soup. Bit-equal positions are welded; the search for intersections skips triangles without area
/// and triangles that use a position twice.
struct MeshAudit {
    bool available = false; ///< false in a build without CGAL; the other fields are then unset

    std::size_t self_intersections = 0; ///< pairs of triangles that intersect beyond a shared edge or vertex
    std::array<std::uint32_t, 2> first_faces = {no_index, no_index}; ///< of the pair with the lowest numbers
    Vec3d first_place{0};                                            ///< near their intersection

    bool closed = false; ///< a consistently oriented manifold without boundary
    /// Closed, every outer shell is oriented outwards and every inner wall inwards, and no two faces intersect.
    bool bounds_volume = false;
    /// Closed, and each shell is oriented according to its nesting, whether or not faces intersect. Shells that intersect
    /// are not nested.
    bool outward = false;
    double volume = 0; ///< enclosed volume if closed; the volume of cavities is subtracted

    // Sets of triangles connected through edges.
    std::size_t components = 0;
    std::size_t closed_components = 0;
    std::size_t inverted_components = 0; ///< closed ones oriented against their nesting
    std::size_t nested_components = 0;   ///< closed ones inside an odd number of others: walls of cavities
};

/// Memory that audit() takes at most, with the triangles; 0 in a build without CGAL.
std::uint64_t audit_memory(std::uint64_t positions, std::uint64_t triangles) noexcept;

/// The result does not depend on the number of threads.
MeshAudit audit(const Mesh& mesh, const std::vector<Triangle>& triangles);

} // namespace bake
