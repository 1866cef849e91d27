// Exact audits of a mesh by CGAL: right where floating-point tests are not.
//
// Each of two things misses what the other finds: a sphere turned inside out cuts itself nowhere, and two spheres grown
// into each other look outwards everywhere. A torus displaced by -2 r is a good torus again: that, only the local test of
// the displacement sees.
#pragma once
#include "bake/mesh/triangulate.h"

namespace bake {

/// What CGAL says of a triangle soup. Positions equal to the bit are one; triangles without area and those that use a
/// position twice are left out of the search for intersections.
struct MeshAudit {
    bool available = false; ///< false in a build without CGAL: the rest is then unset

    std::size_t self_intersections = 0; ///< pairs of triangles that meet beyond a shared edge or vertex
    std::array<std::uint32_t, 2> first_faces = {no_index,
                                                no_index}; ///< of such a pair, the one with the lowest numbers
    Vec3d first_place{0};                                  ///< near where they meet

    bool closed = false; ///< a manifold without boundary, faces turned alike
    /// Closed, every outer shell looks outwards and every inner wall inwards, and no two faces cut each other.
    bool bounds_volume = false;
    /// Closed, and shells look as their nesting wants, whether or not faces cut each other. Shells that cut each other
    /// are not nested.
    bool outward = false;
    double volume = 0; ///< enclosed, when closed; walls of hollows count against it

    // Sets of triangles connected through edges.
    std::size_t components = 0;
    std::size_t closed_components = 0;
    std::size_t inverted_components = 0; ///< closed ones that look the wrong way for their nesting
    std::size_t nested_components = 0;   ///< closed ones inside an odd number of others: walls of hollows
};

/// Any number of threads gives the same.
MeshAudit audit(const Mesh& mesh, const std::vector<Triangle>& triangles);

} // namespace bake
