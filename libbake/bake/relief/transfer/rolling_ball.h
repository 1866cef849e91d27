// The surface that a rolling ball leaves: normals of a mesh with rounded edges.
//
// The centres of all balls of radius r that fit into the body make the eroded body. For a point p of the mesh, let q be the nearest
// point of the eroded body. The rounded surface has the normal p - q there. At a distance d < r from an edge of 90 degrees this is
// tilted by atan((r - d) / r), so that both sides of the edge agree on the edge. A ball that rolls outside does the same to concave
// edges, from the other side; it rolls first, and the ball inside rolls on the surface that it leaves.
//
// q is found by cutting planes: it is the nearest point to p under the plane at depth r below p and below the tangent planes of
// what is nearer to q than r, until nothing is. For convex polyhedra this is exact.
#pragma once
#include "bake/mesh/triangle_tree.h"
#include "bake/relief/transfer/half_spaces.h"
#include "bake/relief/transfer/smooth_patches.h"
#include <memory>

namespace bake {

class RollingBall {
public:
    /// The arguments must outlive the object. `radius`: above 0, object units; at most the diagonal of the mesh is
    /// used.
    RollingBall(const MeshSurface& surface, const SmoothPatches& patches, double radius);

    struct Rounded {
        Vec3d normal{0};     ///< unit; zero where the mesh has none
        bool fits = true;    ///< the whole radius does; else the largest ball that does was used
        bool tilted = false; ///< an edge is near enough to turn the normal
    };
    /// At the barycentrics (1 - b1 - b2, b1, b2) of a triangle of the surface.
    Rounded at(std::uint32_t triangle, double b1, double b2) const noexcept;

private:
    enum class Side { inside, outside };
    struct Place {
        Vec3d p, n;   ///< n points away from the balls
        Vec3d turned; ///< n after the ball outside has rolled
        std::uint32_t patch;
        Side side;
    };
    struct Touch;
    /// From p to the centre of a ball of this radius.
    std::optional<Vec3d> settle(const Place& place, double radius) const noexcept;
    Vec3d turned(const Touch& touch) const noexcept;
    std::optional<Touch> nearest_touch(const Place& place, const Vec3d& q, double radius) const noexcept;
    Vec3d tangent_normal(const Place& place, const Vec3d& q, std::uint32_t triangle,
                         const NearestPoint& foot) const noexcept;
    Vec3d mean_normal(const Vec3d& at, double within) const noexcept;
    /// The unit direction from the centre of the largest ball that fits, at most of the whole radius.
    Vec3d rounded(const Place& place, bool& fits) const noexcept;
    Vec3d filleted(const Vec3d& p, const Vec3d& n, std::uint32_t patch, bool& fits) const noexcept;
    Vec3d facet_normal(const Triangle& triangle) const noexcept;
    bool is_near_edge(const TriangleTree* edges, double reach, const Vec3d& p) const noexcept;

    const MeshSurface& surface_;
    const SmoothPatches& patches_;
    double radius_;
    TriangleTree tree_;
    std::unique_ptr<TriangleTree> convex_, concave_; ///< edges; null if there are none
    double convex_reach_ = 0, concave_reach_ = 0;    ///< from an edge of that kind, beyond which it turns nothing
    std::vector<Vec3d> facets_;                      ///< unit normals of triangles
    std::vector<std::uint8_t> curved_;               ///< triangles whose normals are not those of the facet
};

} // namespace bake
