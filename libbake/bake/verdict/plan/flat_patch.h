// A placed mesh that is a flat, convex polygon with an affine chart, and what a camera sees of it.
#pragma once
#include "bake/verdict/plan/picture_view.h"
#include <optional>
#include <vector>

namespace bake {

/// In world space, relative to scene.origin.
struct FlatPatch {
    std::vector<Vec3d> corners; ///< of the polygon, around it
    Vec3d n{0};                 ///< unit normal, on the side of the relief that rises
    double lift = 1;            ///< length in the world of a height of 1
    Vec3d p0{0};                ///< where u = v = 0
    Vec3d p_u{0}, p_v{0};

    Vec2d uv(const Vec3d& p) const noexcept;
    /// In two perpendicular axes of the plane: a height with slopes b_u, b_v rises by b_u g_u + b_v g_v in the world.
    struct Slopes {
        Vec2d g_u{0}, g_v{0};
    };
    Slopes slopes() const noexcept;
};

/// Nothing unless every point of the polygon belongs to one triangle, uvs are an affine function of the place, and normals are
/// those of the plane.
std::optional<FlatPatch> flat_patch(const Scene& scene, std::uint32_t instance);

/// Of the visible part of a patch with heights of at most `height`, world units, above and below the plane.
struct PatchInPicture {
    Vec3d n{0};                  ///< towards the viewer
    double area = 0;             ///< of the patch without relief, in pixels
    double shift = 0;            ///< pixels by which a height moves a point at most
    double border = 0;           ///< length of the border in pixels
    int edges = 0;               ///< edges of the border that are seen
    double most_tangent = 0;     ///< of the angle between normal and view
    double most_density = 0;     ///< pixels per area of the patch
    Vec2d uv_low{0}, uv_high{0}; ///< a box of the uvs that are seen
};
/// Nothing if the camera is too close to the plane, or sees it edge on; area is 0 if nothing is seen.
std::optional<PatchInPicture> in_picture(const FlatPatch& patch, double height, const PictureView& view);

} // namespace bake
