// Materials, and the normal they shade with: plain, from a bump table, or from a normal map.
#pragma once
#include "bake/light/bsdf.h"
#include "bake/preview/shape.h"
#include "bake/preview/texture.h"

namespace bake {

/// At most one of bump_table and normal_map is set.
struct Material {
    std::string name;
    BlinnPhong<float> bsdf;
    Vec3f reflect{0};   ///< of what is seen in the mirror direction
    Texture albedo;     ///< multiplies ambient and diffuse
    Texture bump_table; ///< slopes b_u, b_v per unit of u and v
    Texture normal_map; ///< tangent-space vectors, not necessarily unit
};

/// The material's reflection model at a point, its texture applied.
BlinnPhong<float> bsdf_at(const Material& material, const Shape& shape, const ShapePoint& at) noexcept;

/// The unit normal to shade with, outward, in object space; zero where the mesh has none.
/// Bump table: the surface-gradient normal of slopes (b_u, b_v) and height 0 on the smooth surface's jet.
/// Normal map: normalize(t.x T + t.y B + t.z N), B = sign (N x T), T and N interpolated without normalising.
/// Where the chart has no area, or the relief gives no direction, the plain normal.
Vec3f shading_normal(const Material& material, const Shape& shape, const ShapePoint& at) noexcept;

/// The mirror direction of a viewer v about n, kept above the facet: where relief tilts n so far that the mirror image
/// points below the facet (v . facet > 0 > r . facet), it is mirrored up again at the facet. All are unit.
Vec3f mirror_above(const Vec3f& v, const Vec3f& n, const Vec3f& facet) noexcept;

} // namespace bake
