// Positions and normals of the vertices of a displaced mesh, for the tessellator.
#pragma once
#include "bake/relief/displace/seam_blend.h"
#include "bake/surface/patch/tessellator.h"

namespace bake {

/// Statistics of the vertices, combined in a fixed order.
struct PointTally {
    double height_min = 0, height_max = 0;
    bool any = false; ///< height_min and height_max are set
    std::uint64_t seam_points = 0;
    double seam_mismatch = 0;
    Vec3d seam_worst{0};
    std::uint64_t folded = 0;
    double fold_margin = 1;
    Vec3d fold_worst{0};
    Vec2d fold_worst_uv{0};
    std::uint64_t no_tangents = 0, no_normal = 0, not_finite = 0;
    std::vector<std::uint32_t> without_normal; ///< indices of normals that must be computed from the faces

    void height(double b) noexcept;
    void fold(double margin, const SurfacePoint& point) noexcept;
    void add(const PointTally& later);
};

/// Tessellates a surface under its relief. `margin` gets the fold margin of every vertex where its size is that of the
/// positions.
Mesh displaced_mesh(const ReliefSurface& surface, const SeamBlend& blend, Seam seam, const PatchLayout& layout,
                    std::vector<float>& margin, PointTally& tally, Progress* progress);

} // namespace bake
