// What a sample of a pixel covers on a surface, by a cone around its ray.
//
// Akenine-Moeller et al., Texture Level of Detail Strategies for Real-Time Ray Tracing, Ray Tracing Gems, 2019;
// Akenine-Moeller et al., Improved Shader and Texture Level of Detail Using Ray Cones, JCGT 2021.
#pragma once
#include "bake/preview/shape.h"
#include "bake/ray/camera.h"
#include <array>
#include <glm/mat3x3.hpp>

namespace bake {

/// The diameter of a cone around a ray is width + spread t at the distance t. Zeros: a ray without extent.
struct RayCone {
    float width = 0, spread = 0;
};

/// The cone of one of `spp` samples of a pixel in perspective. `step`: the edge of a pixel at distance 1 in the direction of
/// the view; `cosine`: of the angle between that direction and the ray. The pixel subtends step^2 cosine^3.
RayCone perspective_cone(float step, float cosine, int spp) noexcept;
/// The cone around a ray of a camera's picture that is `height` pixels high.
RayCone camera_cone(const CameraFrame& frame, const Ray& ray, int height, int spp) noexcept;

/// The ellipse in which a cone meets the plane of a facet, in uv: its two axes, from end to end. `minor` is the one across
/// the ray. Zeros where nothing is known.
struct Footprint {
    Vec2f major{0}, minor{0};
};

/// Where a cone of diameter `width` around `direction` (unit length) meets the plane of a triangle.
class ConeSection {
public:
    /// `facet` is the unit normal of the triangle; `linear` takes vectors from object to world space.
    ConeSection(const Shape& shape, const glm::mat3& linear, std::uint32_t triangle, const Vec3f& facet,
                const Vec3f& direction, float width) noexcept;
    /// Zero for a corner without uv.
    Footprint footprint() const noexcept;
    /// By how much a mirror widens the spread of the cone. Convex surfaces do: by the change of the interpolated normal over
    /// the cone's width. Concave ones count as flat.
    float mirror_spread() const noexcept;

private:
    /// Barycentrics b1, b2 by which a vector in the plane moves a point.
    Vec2d move(const Vec3d& by) const noexcept;

    const Shape& shape_;
    const std::array<std::uint32_t, 3>& corner_;
    Vec3d facet_, direction_;
    float width_;
    // In double: squares of the areas of small triangles are out of the range of float.
    Vec3d e1_, e2_; ///< edges
    Vec3d normal_;  ///< their cross product over its square
    Vec3d side_;    ///< unit, in the plane and across the ray
};

} // namespace bake
