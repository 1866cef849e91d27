// What textures change of a material besides its normal, and where rays pass a surface.
#pragma once
#include "bake/preview/reflectance.h"
#include "bake/preview/shape.h"
#include "bake/preview/texture.h"
#include "bake/ray/bvh.h"

namespace bake {

/// Beyond the unit square of uvs along an axis.
enum class MapWrap { repeat, clamp, mirror };

/// A texture, and how it lies on a shape.
struct SurfaceMap {
    Texture texture; ///< three channels; null: none
    int uvs = -1;    ///< attribute of the shape's mesh with two components; -1: its uvs
    MapWrap wrap_u = MapWrap::repeat, wrap_v = MapWrap::repeat;
    bool nearest = false; ///< the texel that holds the uv, not interpolated

    explicit operator bool() const noexcept { return bool(texture); }
    /// Lies on the shape's uvs, repeats and interpolates.
    bool is_plain() const noexcept {
        return uvs < 0 && wrap_u == MapWrap::repeat && wrap_v == MapWrap::repeat && !nearest;
    }
    bool same_as(const SurfaceMap& other) const noexcept {
        return texture.get() == other.texture.get() && uvs == other.uvs && wrap_u == other.wrap_u &&
               wrap_v == other.wrap_v && nearest == other.nearest;
    }
};

enum class AlphaMode {
    opaque,
    mask,  ///< rays pass where alpha is below the cutoff
    blend, ///< rays pass by chance, with the probability 1 - alpha
};

/// All textures are factors on values of the Reflectance.
struct SurfaceMaps {
    SurfaceMap base;      ///< on ambient and diffuse
    SurfaceMap specular;  ///< on the highlight's colour
    SurfaceMap shininess; ///< red channel
    SurfaceMap roughness; ///< green channel
    SurfaceMap metallic;  ///< blue channel
    SurfaceMap occlusion; ///< red channel: see occlusion_at()
    SurfaceMap emission;  ///< on the emission
    SurfaceMap alpha;     ///< red channel
    float occlusion_strength = 1;
    int vertex_colours =
        -1; ///< attribute of the shape's mesh with three or four components, a factor on base colour and alpha
    float opacity = 1; ///< factor on alpha
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool one_sided = false; ///< back faces (whose corners are clockwise) are invisible to the camera, but cast shadows
    bool unlit = false;     ///< emits its base colour and reflects nothing
};

/// The alpha of a picture, in three equal channels; null if it has none or is opaque. Throws as read_image().
Texture read_alpha(const std::string& file);

/// The reflectance at a point; `tint` multiplies ambient and diffuse. Maps on the shape's own uvs are looked up over the
/// footprint, if they have mips.
Bsdf mapped_bsdf(const SurfaceMaps& maps, Reflectance reflectance, const Vec3f& tint, const Shape& shape,
                 const ShapePoint& at, const Footprint& footprint = {}) noexcept;

/// Factor on ambient light and on what diffuse terms reflect of the sky, in [0, 1].
float occlusion_at(const SurfaceMaps& maps, const Shape& shape, const ShapePoint& at,
                   const Footprint& footprint = {}) noexcept;

/// Which rays pass a placed shape. Empty if none does. `mirrored`: the placement reverses the order of corners. The shape
/// must outlive the filters.
PassFilter seen_filter(const std::shared_ptr<const SurfaceMaps>& maps, const Shape& shape, bool mirrored);
PassFilter light_filter(const std::shared_ptr<const SurfaceMaps>& maps, const Shape& shape);

} // namespace bake
