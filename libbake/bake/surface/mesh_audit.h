// Exact audits of a mesh by CGAL: slow, and right where floating-point tests are not.
#pragma once
#include "bake/asset/triangulate.h"

namespace bake {

/// What CGAL says of a triangle soup.
struct MeshAudit {
    bool available = false;            ///< false in a build without CGAL: the rest is then unset
    std::size_t self_intersections = 0; ///< pairs of triangles that intersect beyond a shared edge or vertex
    bool closed = false;               ///< a manifold without boundary
    bool outward = false;              ///< closed and oriented so that it bounds a volume
    double volume = 0;                 ///< enclosed, when closed
};

MeshAudit audit(const Mesh& mesh, const std::vector<Triangle>& triangles);

} // namespace bake
