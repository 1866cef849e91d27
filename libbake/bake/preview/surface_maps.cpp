#include "bake/preview/surface_maps.h"
#include "bake/picture/image_io.h"
#include "bake/preview/sampler.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace bake {
namespace {

/// Values of an attribute between the corners; `missing` beyond its components.
Vec4f attribute_at(const Shape& shape, const ShapePoint& at, int index, float missing) noexcept {
    const Attribute& attribute = shape.mesh.attributes[std::size_t(index)];
    const auto& corner = shape.surface.triangles[at.triangle].corner;
    const float share[3] = {1 - at.b1 - at.b2, at.b1, at.b2};
    Vec4f sum(missing);
    for (int c = 0; c < std::min(attribute.components, 4); ++c) {
        sum[c] = 0;
        for (int k = 0; k < 3; ++k)
            sum[c] += share[k] *
                      attribute.values[std::size_t(corner[k]) * std::size_t(attribute.components) + std::size_t(c)];
    }
    return sum;
}

/// The place in [0, 1] that a texture which repeats and interpolates shows as the map shows u, on an axis of n texels.
double wrapped(double u, MapWrap wrap, bool nearest, int n) noexcept {
    if (!std::isfinite(u)) return 0;
    switch (wrap) {
    case MapWrap::repeat: u -= std::floor(u); break;
    case MapWrap::mirror: u = std::abs(u - 2 * std::round(u / 2)); break;
    case MapWrap::clamp: u = std::clamp(u, 0.0, 1.0); break;
    }
    if (nearest) return (std::min(std::floor(u * n), n - 1.0) + 0.5) / n;
    // Between the outermost centres of texels nothing is interpolated across the border.
    return wrap == MapWrap::repeat ? u : std::clamp(u, 0.5 / n, 1 - 0.5 / n);
}

Vec3f lookup(const SurfaceMap& map, const Shape& shape, const ShapePoint& at,
             const Footprint& footprint = {}) noexcept {
    if (map.is_plain()) return lookup3(map.texture, uv_at(shape, at), footprint);
    const Vec2f uv = map.uvs < 0 ? uv_at(shape, at) : Vec2f(attribute_at(shape, at, map.uvs, 0));
    const auto value_at = [&map](int level, const Vec2f& place) {
        const Image<float>& image = level < 0 ? *map.texture : map.texture.mips->levels[std::size_t(level)];
        const bool nearest = map.nearest && level < 0;
        return bilinear<3>(image, Vec2f(Vec2d(wrapped(double(place.x), map.wrap_u, nearest, image.width()),
                                              wrapped(double(place.y), map.wrap_v, nearest, image.height()))));
    };
    // The footprint is that of the shape's own uvs.
    const bool filtered = map.texture.mips && map.uvs < 0;
    const auto value = mean_over<3>(filtered ? taps_of(*map.texture.mips, uv, footprint) : Taps{.first = uv}, value_at);
    return {value[0], value[1], value[2]};
}

/// At a point: a ray passes or it does not. A mean alpha that is compared with the cutoff would not show the share of the
/// footprint that is covered, and a ray does not carry its cone here; the mean over samples is the covered share.
float alpha_at(const SurfaceMaps& maps, const Shape& shape, const ShapePoint& at) noexcept {
    float alpha = maps.opacity;
    if (maps.alpha) alpha *= lookup(maps.alpha, shape, at).x;
    if (maps.vertex_colours >= 0) alpha *= attribute_at(shape, at, maps.vertex_colours, 1).w;
    return alpha;
}

/// A number in [0, 1) that is the same for the same ray and triangle.
float chance(const Crossing& at) noexcept {
    std::uint64_t bits = std::uint64_t(at.mesh) << 32 | at.triangle;
    for (const float value : {at.origin.x, at.origin.y, at.origin.z, at.direction.x, at.direction.y, at.direction.z})
        bits = hash(bits ^ std::bit_cast<std::uint32_t>(value + 0.0f)); // minus zero becomes zero
    return float(bits >> 40) * 0x1p-24f;
}

bool passes_alpha(const SurfaceMaps& maps, const Shape& shape, const Crossing& at) noexcept {
    if (maps.alpha_mode == AlphaMode::opaque) return false;
    const float alpha = alpha_at(maps, shape, {at.triangle, at.b1, at.b2});
    return maps.alpha_mode == AlphaMode::mask ? alpha < maps.alpha_cutoff : chance(at) >= alpha;
}

} // namespace

Texture read_alpha(const std::string& file) {
    ImageInfo info;
    const Image<float> image = read_image(file, &info);
    if (info.alpha_channel < 0) return nullptr;
    Image<float> alpha(image.width(), image.height(), 3);
    bool opaque = true;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const float value = image.at(x, y, info.alpha_channel);
            opaque = opaque && value >= 1;
            for (int c = 0; c < 3; ++c) alpha.at(x, y, c) = std::isfinite(value) ? std::clamp(value, 0.f, 1.f) : 1;
        }
    return opaque ? nullptr : std::make_shared<const Image<float>>(std::move(alpha));
}

Bsdf mapped_bsdf(const SurfaceMaps& maps, Reflectance r, const Vec3f& tint, const Shape& shape, const ShapePoint& at,
                 const Footprint& footprint) noexcept {
    Vec3f base = tint;
    if (maps.base) base *= lookup(maps.base, shape, at, footprint);
    if (maps.vertex_colours >= 0) base *= Vec3f(attribute_at(shape, at, maps.vertex_colours, 1));
    if (maps.unlit) {
        Bsdf shown;
        shown.emission = r.diffuse * base;
        return shown;
    }
    if (maps.specular) r.specular *= lookup(maps.specular, shape, at, footprint);
    if (maps.shininess) r.shininess *= lookup(maps.shininess, shape, at, footprint).x;
    const bool shared = maps.roughness && maps.metallic.same_as(maps.roughness); // as glTF has them
    if (maps.roughness) {
        const Vec3f value = lookup(maps.roughness, shape, at, footprint);
        r.roughness *= value.y;
        if (shared) r.metallic *= value.z;
    }
    if (maps.metallic && !shared) r.metallic *= lookup(maps.metallic, shape, at, footprint).z;
    if (maps.emission) r.emission *= lookup(maps.emission, shape, at, footprint);
    Bsdf bsdf = make_bsdf(r, base);
    if (maps.occlusion) bsdf.ambient *= occlusion_at(maps, shape, at, footprint);
    return bsdf;
}

float occlusion_at(const SurfaceMaps& maps, const Shape& shape, const ShapePoint& at,
                   const Footprint& footprint) noexcept {
    if (!maps.occlusion) return 1;
    const float value = lookup(maps.occlusion, shape, at, footprint).x;
    return std::clamp(1 + maps.occlusion_strength * (value - 1), 0.f, 1.f);
}

PassFilter seen_filter(const std::shared_ptr<const SurfaceMaps>& maps, const Shape& shape, bool mirrored) {
    if (!maps || (maps->alpha_mode == AlphaMode::opaque && !maps->one_sided)) return {};
    return [maps, &shape, mirrored](const Crossing& at) {
        return (maps->one_sided && at.behind != mirrored) || passes_alpha(*maps, shape, at);
    };
}

PassFilter light_filter(const std::shared_ptr<const SurfaceMaps>& maps, const Shape& shape) {
    if (!maps || maps->alpha_mode == AlphaMode::opaque) return {};
    return [maps, &shape](const Crossing& at) { return passes_alpha(*maps, shape, at); };
}

} // namespace bake
