#include "bake/preview/material.h"
#include "bake/preview/widen.h"
#include <map>

namespace bake {
namespace {

/// The normal N - s_u along_u - s_v along_v of slopes (s_u, s_v), and what their covariance means for its direction.
struct Slanted {
    Vec3f normal, along_u, along_v;

    /// Variance per axis of the slopes around the unit normal, after `to_world`. Changes along the normal itself do not turn
    /// it.
    float variance(const Vec3f& covariance, const glm::mat3& to_world) const noexcept {
        const Vec3f n = to_world * normal, u = to_world * along_u, v = to_world * along_v;
        const float squared = glm::dot(n, n), n_u = glm::dot(n, u), n_v = glm::dot(n, v);
        if (!(squared > 0)) return 0;
        const auto sum = [&](float uu, float vv, float uv) {
            return covariance.x * uu + covariance.y * vv + 2 * covariance.z * uv;
        };
        const float all = sum(glm::dot(u, u), glm::dot(v, v), glm::dot(u, v));
        const float turning = (all - sum(n_u * n_u, n_v * n_v, n_u * n_v) / squared) / (2 * squared);
        return std::isfinite(turning) ? std::max(0.0f, turning) : 0;
    }
};

/// The surface-gradient normal of a jet; see displaced_normal.h.
Slanted slanted(const Jet<float>& jet, const Vec2f& slopes) noexcept {
    const float area = glm::dot(jet.n, glm::cross(jet.p_u, jet.p_v));
    if (area == 0) return {};
    const Vec3f u = glm::cross(jet.p_v, jet.n) / area, v = glm::cross(jet.n, jet.p_u) / area;
    return {jet.n - slopes.x * u - slopes.y * v, u, v};
}

bool keeps_variance(const Material& material, const Lookup& lookup) noexcept {
    return material.always_moments || lookup.filter == TextureFilter::moments;
}

bool is_filtered(const Material& material, const Lookup& lookup) noexcept {
    return material.always_moments || lookup.filter != TextureFilter::off;
}

/// Mean slopes of a table over the footprint; the slopes at the point where there are no mips.
template <class Point>
SlopeMoments slopes_over(const std::shared_ptr<const Mips>& mips, const Material& material, const Vec2f& uv,
                         const Lookup& lookup, const Point& point) noexcept {
    if (!mips || !is_filtered(material, lookup)) return {.mean = point(uv)};
    const Taps taps = taps_of(*mips, uv, lookup.footprint);
    return taps.is_point() ? SlopeMoments{.mean = point(uv)} : moments_over(*mips, taps, point);
}

MeanNormal bumped(const Material& material, const Shape& shape, const ShapePoint& at, const Lookup& lookup) noexcept {
    const Jet<float> jet = jet_at(shape.surface, at.triangle, at.b1, at.b2);
    if (jet.sigma == 0) return {};
    const SlopeMoments slopes = slopes_over(material.bump_table.mips, material, uv_at(shape, at), lookup,
                                            [&](const Vec2f& uv) { return lookup2(*material.bump_table, uv); });
    MeanNormal mean{
        displaced_normal(jet, Height<float>{0, slopes.mean.x, slopes.mean.y}, NormalMethod::surface_gradient)};
    if (keeps_variance(material, lookup) && slopes.covariance != Vec3f(0))
        mean.variance = slanted(jet, slopes.mean).variance(slopes.covariance, lookup.normals);
    return mean;
}

MeanNormal raised(const Material& material, const Shape& shape, const ShapePoint& at, const Lookup& lookup) noexcept {
    const Jet<float> jet = jet_at(shape.surface, at.triangle, at.b1, at.b2);
    if (jet.sigma == 0) return {};
    const Vec2f uv = uv_at(shape, at);
    Height<float> h = material.height->at(uv.x, uv.y);
    const SlopeMoments slopes = slopes_over(material.height_mips, material, uv, lookup, [&](const Vec2f& point) {
        const Height<float> there = material.height->at(point.x, point.y);
        return Vec2f(there.b_u, there.b_v);
    });
    h.b_u = slopes.mean.x, h.b_v = slopes.mean.y;
    const bool inside_out = material.height_method == NormalMethod::exact && folds(jet, h.b);
    MeanNormal mean{
        displaced_normal(jet, h, inside_out ? NormalMethod::blinn : material.height_method, material.height_scale)};
    if (keeps_variance(material, lookup) && slopes.covariance != Vec3f(0))
        mean.variance = slanted(jet, slopes.mean).variance(slopes.covariance, lookup.normals);
    return mean;
}

MeanNormal mapped(const Material& material, const Shape& shape, const ShapePoint& at, const Vec3f& normal,
                  const Lookup& lookup) noexcept {
    const auto& c = shape.surface.triangles[at.triangle].corner;
    for (const std::uint32_t corner : c)
        if (shape.mesh.corner_uv[corner] == no_index) return {};
    const Vec4f &t0 = shape.tangents[c[0]], &t1 = shape.tangents[c[1]], &t2 = shape.tangents[c[2]];
    const Vec3f tangent = (1 - at.b1 - at.b2) * Vec3f(t0) + at.b1 * Vec3f(t1) + at.b2 * Vec3f(t2);
    const Vec3f bitangent = t0.w * glm::cross(normal, tangent); // the corners of a triangle have equal signs
    const Vec2f uv = uv_at(shape, at);
    const auto& mips = material.normal_map.mips;
    const Taps taps = mips && is_filtered(material, lookup) ? taps_of(*mips, uv, lookup.footprint) : Taps{};
    if (taps.is_point()) {
        const Vec3f t = lookup3(*material.normal_map, uv);
        return {t.x * tangent + t.y * bitangent + t.z * normal};
    }
    const SlopeMoments slopes =
        moments_over(*mips, taps, [&](const Vec2f& point) { return slopes_of(lookup3(*material.normal_map, point)); });
    const Slanted mean{normal - slopes.mean.x * tangent - slopes.mean.y * bitangent, tangent, bitangent};
    return {mean.normal, keeps_variance(material, lookup) ? mean.variance(slopes.covariance, lookup.normals) : 0};
}

/// Toksvig: the mean of unit vectors is the shorter the more they vary.
MeanNormal object_mapped(const Material& material, const Shape& shape, const ShapePoint& at,
                         const Lookup& lookup) noexcept {
    const Vec2f uv = uv_at(shape, at);
    const auto& mips = material.object_normals.mips;
    const Taps taps = mips && is_filtered(material, lookup) ? taps_of(*mips, uv, lookup.footprint) : Taps{};
    if (taps.is_point()) return {lookup3(*material.object_normals, uv)};
    const Vec3f mean = lookup3(material.object_normals, uv, lookup.footprint);
    const float length = glm::length(mean);
    const float variance = length > 0 ? std::max(0.0f, 1 - length) / length : 0;
    return {mean, keeps_variance(material, lookup) ? variance : 0};
}

} // namespace

void add_mips(std::span<const std::unique_ptr<Material>> materials, TextureFilter filter) {
    enum class Holds { colours, slopes, normals };
    std::map<std::pair<const Image<float>*, Holds>, std::shared_ptr<const Mips>> made;
    const auto add = [&](Texture& texture, Holds holds) {
        if (!texture || texture.mips) return;
        auto& mips = made[{texture.get(), holds}];
        if (!mips)
            mips = holds == Holds::colours  ? colour_mips(*texture)
                   : holds == Holds::slopes ? slope_mips(*texture)
                                            : normal_mips(*texture);
        texture.mips = mips;
    };
    std::map<const SurfaceMaps*, std::shared_ptr<const SurfaceMaps>> filtered;
    const auto add_to_maps = [&](std::shared_ptr<const SurfaceMaps>& maps) {
        auto& with_mips = filtered[maps.get()];
        if (!with_mips) {
            auto copy = std::make_shared<SurfaceMaps>(*maps); // that of the rays' filters stays as it is
            for (SurfaceMap* map : {&copy->base, &copy->specular, &copy->shininess, &copy->roughness, &copy->metallic,
                                    &copy->emission, &copy->occlusion})
                if (map->uvs < 0) add(map->texture, Holds::colours);
            with_mips = std::move(copy);
        }
        maps = with_mips;
    };
    for (const auto& material : materials) {
        if (filter != TextureFilter::off) {
            add(material->albedo, Holds::colours);
            if (material->maps) add_to_maps(material->maps);
        }
        if (filter == TextureFilter::off && !material->always_moments) continue;
        add(material->bump_table, Holds::slopes);
        add(material->normal_map, Holds::normals);
        add(material->object_normals, Holds::colours);
    }
}

Bsdf bsdf_at(const Material& material, const Shape& shape, const ShapePoint& at, const Lookup& lookup,
             float variance) noexcept {
    const Footprint print = lookup.filter == TextureFilter::off ? Footprint{} : lookup.footprint;
    const Vec3f tint = material.albedo ? lookup3(material.albedo, uv_at(shape, at), print) : Vec3f(1);
    Bsdf bsdf = material.maps ? mapped_bsdf(*material.maps, material.reflectance, tint, shape, at, print)
                              : make_bsdf(material.reflectance, tint);
    widen(bsdf, variance);
    return bsdf;
}

bool has_relief(const Material& material) noexcept {
    return material.height || material.object_normals || material.bump_table || material.normal_map;
}

bool has_textures(const Material& material) noexcept {
    return material.albedo || material.maps || has_relief(material);
}

MeanNormal mean_normal(const Material& material, const Shape& shape, const ShapePoint& at,
                       const Lookup& lookup) noexcept {
    const Vec3f normal = normal_at(shape, at);
    MeanNormal relief;
    if (material.height) relief = raised(material, shape, at, lookup);
    else if (material.object_normals) relief = object_mapped(material, shape, at, lookup);
    else if (material.bump_table) relief = bumped(material, shape, at, lookup);
    else if (material.normal_map && !shape.tangents.empty()) relief = mapped(material, shape, at, normal, lookup);
    relief.n = unit_or_zero(relief.n);
    return relief.n != Vec3f(0) ? relief : MeanNormal{unit_or_zero(normal)};
}

Vec3f shading_normal(const Material& material, const Shape& shape, const ShapePoint& at) noexcept {
    return mean_normal(material, shape, at, {}).n;
}

Vec3f mirror_above(const Vec3f& v, const Vec3f& n, const Vec3f& facet) noexcept {
    const Vec3f r = 2 * glm::dot(n, v) * n - v;
    const float height = glm::dot(r, facet);
    return height < 0 ? r - 2 * height * facet : r;
}

} // namespace bake
