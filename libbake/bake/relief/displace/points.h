// The points of a displaced mesh: positions, normals and uvs, each written once.
#pragma once
#include "bake/relief/displace/layout.h"
#include "bake/relief/displace/seam_blend.h"

namespace bake {

class Progress;

/// What the points say of themselves, gathered in a fixed order.
struct PointTally {
    double height_min = 0, height_max = 0;
    bool any = false;
    std::uint64_t seam_points = 0;
    double seam_mismatch = 0;
    Vec3d seam_worst{0};
    std::uint64_t folded = 0;
    double fold_margin = 1;
    Vec3d fold_worst{0};
    Vec2d fold_worst_uv{0};
    std::uint64_t no_tangents = 0, no_normal = 0, not_finite = 0;
    std::vector<std::uint32_t> without_normal; ///< numbers of normals that the faces must give

    void height(double b) noexcept;
    void fold(double margin, const SurfacePoint& point) noexcept;
    void add(const PointTally& later);
};

/// Fills positions, normals, uvs of a mesh whose arrays have the layout's sizes, and `margin` where it is not empty.
PointTally write_points(const ReliefSurface& surface, const SeamBlend& blend, Seam seam, const DisplaceLayout& layout,
                        Mesh& mesh, std::vector<float>& margin, Progress* progress);

} // namespace bake
