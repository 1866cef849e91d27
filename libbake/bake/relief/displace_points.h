// The points of a displaced mesh: positions, normals and uvs, each written once.
#pragma once
#include "bake/relief/displace_layout.h"
#include "bake/relief/seam_blend.h"

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

/// Where sides meet: the point they share, and each group's normal and uv.
struct SideView {
    SurfacePoint point;
    ReliefValue value;    ///< with the blend's correction
    Vec3d own{0};         ///< the value without it
};
struct MetPoint {
    Vec3d p, from;                ///< displaced, and on the base
    Vec3d value;                  ///< shared
    double mismatch = 0;          ///< largest difference between two uv groups' own values
    double margin = 1;
    std::vector<Vec3d> normal;    ///< per normal group: unit or zero
    std::vector<Vec2d> uv;        ///< per uv group
};
void meet(const ReliefSurface& surface, Seam seam, const Meeting& meeting, const MeetingSide* sides,
          std::span<const SideView> views, MetPoint& out);

/// Fills positions, normals, uvs of a mesh whose arrays have the layout's sizes, and `margin` where it is not empty.
PointTally write_points(const ReliefSurface& surface, const SeamBlend& blend, Seam seam, const DisplaceLayout& layout,
                        Mesh& mesh, std::vector<float>& margin, Progress* progress);

} // namespace bake
