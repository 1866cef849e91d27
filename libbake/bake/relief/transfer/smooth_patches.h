// The smooth patches of a mesh, which its hard edges part from each other.
#pragma once
#include "bake/surface/chart/mesh_surface.h"
#include <array>
#include <span>

namespace bake {

struct HardEdge {
    std::array<std::uint32_t, 2> ends; ///< positions
    bool convex = true;                ///< the body lies between the two facets
    double angle = 0;                  ///< between the facets' normals, radians
};

/// Faces belong to one patch if a chain of edges that are not hard connects them. Edges whose sides have normals of their own are hard;
/// in a mesh without any of these, all of hard_edges() are. The surface must outlive the object.
class SmoothPatches {
public:
    explicit SmoothPatches(const MeshSurface& surface);

    std::uint32_t of_face(std::uint32_t face) const noexcept { return patch_[face]; }
    std::uint32_t count() const noexcept { return std::uint32_t(begin_.size() - 1); }
    /// Corners: the normal of the surface, as long as it is that of the corner's patch. Where a mesh is shaded smooth over a hard
    /// edge, the mean of the facets of the patch around the position.
    const std::vector<Vec3f>& normals() const noexcept { return normals_; }
    /// Those of two faces that belong to different patches, with an angle up to 150 degrees.
    const std::vector<HardEdge>& edges() const noexcept { return edges_; }
    /// How many other hard edges have an angle: those with the same patch on both sides, because they end within it, and sharper ones.
    std::size_t kept() const noexcept { return kept_; }
    /// Whether two different patches share a hard edge, or each shares one with the same third patch.
    bool are_near(std::uint32_t a, std::uint32_t b) const noexcept;

private:
    std::span<const std::uint32_t> neighbours(std::uint32_t patch) const noexcept {
        return {neighbours_.data() + begin_[patch], neighbours_.data() + begin_[patch + 1]};
    }
    void set_normals(const MeshSurface& surface, const std::vector<std::uint32_t>& vertex);
    void set_neighbours(std::uint32_t patches, std::vector<std::array<std::uint32_t, 2>> pairs);

    std::vector<std::uint32_t> patch_;              ///< faces
    std::vector<std::uint32_t> begin_, neighbours_; ///< patches + 1; ascending
    std::vector<Vec3f> normals_;
    std::vector<HardEdge> edges_;
    std::size_t kept_ = 0;
};

} // namespace bake
