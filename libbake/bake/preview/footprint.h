// What a sample of a pixel covers on a surface, by a cone around its ray.
//
// Akenine-Moeller et al., Texture Level of Detail Strategies for Real-Time Ray Tracing, Ray Tracing Gems, 2019;
// Akenine-Moeller et al., Improved Shader and Texture Level of Detail Using Ray Cones, JCGT 2021.
#pragma once
#include "bake/preview/shape.h"
#include "bake/ray/ray.h"
#include <glm/mat3x3.hpp>

namespace bake {

/// The diameter of a cone around a ray is width + spread t at the distance t. Zeros: a ray without extent.
struct RayCone {
    float width = 0, spread = 0;
};

/// The cone of one of `spp` samples of a pixel, from the ray through a point of it and those through the same points of the
/// pixels to the right and below.
RayCone pixel_cone(const Ray& ray, const Ray& right, const Ray& below, int spp) noexcept;

/// The ellipse in which a cone meets the plane of a facet, in uv: its two axes, from end to end. `minor` is the one across
/// the ray. Zeros where nothing is known.
struct Footprint {
    Vec2f major{0}, minor{0};
};

/// The footprint of a cone of diameter `width` around `direction` (unit length). `facet` is the unit normal of the
/// triangle; `linear` takes vectors from object to world space. Zero for a corner without uv.
Footprint footprint_at(const Shape& shape, const glm::mat3& linear, const ShapePoint& at, const Vec3f& facet,
                       const Vec3f& direction, float width) noexcept;

/// The cone of the mirror ray that starts where `cone` has arrived at the distance t on a surface. Convex surfaces spread
/// it: by the change of the interpolated normal over the cone's width. Concave ones count as flat.
RayCone mirrored_cone(const Shape& shape, const glm::mat3& linear, const ShapePoint& at, const Vec3f& facet,
                      const Vec3f& direction, const RayCone& cone, float t) noexcept;

} // namespace bake
