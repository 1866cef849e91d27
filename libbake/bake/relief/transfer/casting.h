// Where the rays of a bake start, and where they go: from an envelope around the low-poly mesh through its surface.
//
// Directions are averaged over hard edges, so that both sides of an edge look the same way and no detail beyond it is missed.
// In the middle of a flat face such a direction is skewed, and detail that stands out of the face would move sideways. So each
// corner has two directions, and a texel's is a blend of both by its distance from the nearest hard edge.
#pragma once
#include "bake/mesh/triangle_tree.h"
#include "bake/surface/chart/mesh_surface.h"
#include "bake/surface/chart/uv_raster.h"
#include <memory>
#include <optional>
#include <span>

namespace bake {

/// How far from the low-poly mesh detail is searched, in object units.
struct Reach {
    float front = 0; ///< outside, along the direction of the cast
    float back = 0;  ///< inside; below 0 for rays that end before the mesh
    float blend = 0; ///< distance from a hard edge over which directions turn to the side's own
};
/// Reach::blend for detail that rises up to `out` above the surface and goes down to `in` below it. Below a hard edge neighbouring
/// rays come closer to each other, and must not cross above the detail. On a box averaged directions lean by up to 55 degrees, with
/// a tangent of 1.43, and the blend turns them at most 1.5 times as fast as a linear one, so that a width of 2.1 depths is enough.
/// Above the edge rays part, and a short blend keeps detail in its place.
inline float blend_width(float out, float in) noexcept { return 2.5f * in + 0.5f * out; }

enum class CastBy {
    blend,    ///< averaged near hard edges, the side's own elsewhere
    averaged, ///< over hard edges, everywhere
    face,     ///< normals of the facets
};

/// A ray that goes inward; it meets the low-poly mesh at t = reach.front.
struct Cast {
    Vec3f start{0}, inward{0}; ///< the direction has unit length; zero where there is none
    Reach reach;
};

class Casting {
public:
    /// `reach`: per position of the mesh. The surface must outlive the object.
    Casting(const MeshSurface& low, CastBy by, std::vector<Reach> reach);
    /// Rays from a cage through the mesh, as far behind it as the cage is before it: the same faces with other positions. Throws
    /// Error{Refusal::unsuitable}, which names `path`, for a mesh with other faces.
    Casting(const MeshSurface& low, const Mesh& cage, const std::string& path);

    Cast at(const TexelHit& at) const noexcept;
    /// The same for several points of one triangle.
    void at(std::span<const TexelHit> points, std::span<Cast> casts) const noexcept;
    /// Where a direction leans from the triangle's normal by more than 80 degrees, or sees the triangle from behind, as smooth normals
    /// of strongly bent faces do: the cast turned towards that normal, 80 degrees off it. Nothing elsewhere, and of a cage.
    std::optional<Cast> facing(const TexelHit& at) const noexcept;
    /// The corner of the envelope: the start of a ray there.
    Vec3f envelope(std::uint32_t corner) const noexcept;
    float most_front() const noexcept { return most_front_; }
    float most_back() const noexcept { return most_back_; }
    /// Edges whose two sides have normals of their own, or between facets that are more than 50 degrees apart.
    std::size_t hard_edges() const noexcept { return hard_edges_; }

private:
    struct Corners;
    Corners corners_of(std::uint32_t triangle) const noexcept;
    Cast at(const Corners& corners, const TexelHit& at) const noexcept;
    void set_hard_edges(const std::vector<std::array<std::uint32_t, 2>>& edges);
    float averaged_share(const Vec3f& p, float width) const noexcept;

    const MeshSurface& low_;
    bool cage_ = false;
    std::vector<Vec3f> averaged_; ///< corners; of a cage: to its position
    std::vector<Vec3f> own_;      ///< corners; empty: as averaged_
    std::vector<Vec3f> facets_;   ///< triangles; none for a cage
    bool by_face_ = false;        ///< directions are those of facets_
    std::vector<Reach> reach_;    ///< positions
    std::unique_ptr<TriangleTree> edges_;
    std::size_t hard_edges_ = 0;
    float most_front_ = 0, most_back_ = 0;
};

} // namespace bake
