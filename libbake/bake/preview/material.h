// Materials and their shading normals: plain, from a bump table, or from a normal map.
#pragma once
#include "bake/preview/reflectance.h"
#include "bake/preview/shape.h"
#include "bake/preview/surface_maps.h"
#include "bake/preview/texture.h"
#include "bake/relief/map/displaced_normal.h"
#include <span>

namespace bake {

/// At most one of bump_table, normal_map, object_normals and height is set.
struct Material {
    std::string name;
    Reflectance reflectance;
    Vec3f reflect{0};                                   ///< factor on the radiance from the mirror direction
    Texture albedo;                                     ///< multiplies ambient and diffuse
    Texture bump_table;                                 ///< slopes b_u, b_v per unit of u and v
    Texture normal_map;                                 ///< tangent-space vectors, not necessarily unit
    Texture object_normals;                             ///< the same in object space
    std::shared_ptr<const HeightSampler<float>> height; ///< from which height_method computes normals at each hit
    NormalMethod height_method = NormalMethod::exact;
    ConstantScale<float> height_scale;       ///< for NormalMethod::constant_scale
    std::shared_ptr<const Mips> height_mips; ///< of the slopes of `height`; null: its lookups are at a point
    bool always_moments = false;             ///< relief is filtered by TextureFilter::moments whatever the scene says
    std::shared_ptr<const SurfaceMaps> maps; ///< further textures, alpha and sides; null: none
};

/// What a lookup at a point of a shape covers.
struct Lookup {
    Footprint footprint;
    TextureFilter filter = TextureFilter::off; ///< off: textures are looked up at the point
    glm::mat3 normals{1};                      ///< from object to world space, for the variance of slopes
};

/// Gives the textures their mips, unless they have them. Materials that share a picture share its mips.
void add_mips(std::span<const std::unique_ptr<Material>> materials, TextureFilter filter);

/// The reflection model at a point, including the albedo texture and the maps. `variance` of the slopes around the shading normal widens
/// it.
Bsdf bsdf_at(const Material& material, const Shape& shape, const ShapePoint& at, const Lookup& lookup = {},
             float variance = 0) noexcept;

/// Whether shading normals differ from those of the mesh.
bool has_relief(const Material& material) noexcept;
/// Whether anything is looked up at a point.
bool has_textures(const Material& material) noexcept;

/// The outward unit shading normal in object space; zero where the mesh has no normal.
/// Bump table: the surface-gradient normal for the slopes (b_u, b_v) and height 0 on the jet of the smooth surface.
/// Height: as NormalMethod says; where the displaced surface is inside out, blinn stands in for exact.
/// Normal map: normalize(t.x T + t.y B + t.z N), B = sign (N x T), with T and N interpolated without normalising.
/// Where the chart has no area or the texture yields a zero vector, it is the plain normal.
Vec3f shading_normal(const Material& material, const Shape& shape, const ShapePoint& at) noexcept;

/// A normal, and how much those that it stands for vary around it.
struct MeanNormal {
    Vec3f n{0};         ///< as shading_normal() gives it, for mean slopes
    float variance = 0; ///< of their slopes per axis, in world space; 0 unless filtered by moments
};
MeanNormal mean_normal(const Material& material, const Shape& shape, const ShapePoint& at,
                       const Lookup& lookup) noexcept;

/// The mirror direction r of the viewer direction v about n. If relief tilts n so far that r points below the facet
/// (v . facet > 0 > r . facet), r is reflected at the facet. All vectors have unit length.
Vec3f mirror_above(const Vec3f& v, const Vec3f& n, const Vec3f& facet) noexcept;

} // namespace bake
