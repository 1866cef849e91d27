#include "bake/preview/material.h"

namespace bake {
namespace {

Vec3f bumped(const Material& material, const Shape& shape, const ShapePoint& at) noexcept {
    const Jet<float> jet = jet_at(shape.surface, at.triangle, at.b1, at.b2);
    if (jet.sigma == 0) return Vec3f(0);
    const Vec2f slopes = lookup2(*material.bump_table, uv_at(shape, at));
    return displaced_normal(jet, Height<float>{0, slopes.x, slopes.y}, NormalMethod::surface_gradient);
}

Vec3f raised(const Material& material, const Shape& shape, const ShapePoint& at) noexcept {
    const Jet<float> jet = jet_at(shape.surface, at.triangle, at.b1, at.b2);
    if (jet.sigma == 0) return Vec3f(0);
    const Vec2f uv = uv_at(shape, at);
    const Height<float> h = material.height->at(uv.x, uv.y);
    const bool inside_out = material.height_method == NormalMethod::exact && folds(jet, h.b);
    return displaced_normal(jet, h, inside_out ? NormalMethod::blinn : material.height_method, material.height_scale);
}

Vec3f mapped(const Material& material, const Shape& shape, const ShapePoint& at, const Vec3f& normal) noexcept {
    const auto& c = shape.surface.triangles[at.triangle].corner;
    for (const std::uint32_t corner : c)
        if (shape.mesh.corner_uv[corner] == no_index) return Vec3f(0);
    const Vec4f &t0 = shape.tangents[c[0]], &t1 = shape.tangents[c[1]], &t2 = shape.tangents[c[2]];
    const Vec3f tangent = (1 - at.b1 - at.b2) * Vec3f(t0) + at.b1 * Vec3f(t1) + at.b2 * Vec3f(t2);
    const Vec3f bitangent = t0.w * glm::cross(normal, tangent); // the corners of a triangle have equal signs
    const Vec3f t = lookup3(*material.normal_map, uv_at(shape, at));
    return t.x * tangent + t.y * bitangent + t.z * normal;
}

} // namespace

Bsdf bsdf_at(const Material& material, const Shape& shape, const ShapePoint& at) noexcept {
    const Vec3f tint = material.albedo ? lookup3(*material.albedo, uv_at(shape, at)) : Vec3f(1);
    return material.maps ? mapped_bsdf(*material.maps, material.reflectance, tint, shape, at)
                         : make_bsdf(material.reflectance, tint);
}

bool has_relief(const Material& material) noexcept {
    return material.height || material.object_normals || material.bump_table || material.normal_map;
}

Vec3f shading_normal(const Material& material, const Shape& shape, const ShapePoint& at) noexcept {
    const Vec3f normal = normal_at(shape, at);
    Vec3f relief(0);
    if (material.height) relief = unit_or_zero(raised(material, shape, at));
    else if (material.object_normals) relief = unit_or_zero(lookup3(*material.object_normals, uv_at(shape, at)));
    else if (material.bump_table) relief = unit_or_zero(bumped(material, shape, at));
    else if (material.normal_map && !shape.tangents.empty()) relief = unit_or_zero(mapped(material, shape, at, normal));
    return relief != Vec3f(0) ? relief : unit_or_zero(normal);
}

Vec3f mirror_above(const Vec3f& v, const Vec3f& n, const Vec3f& facet) noexcept {
    const Vec3f r = 2 * glm::dot(n, v) * n - v;
    const float height = glm::dot(r, facet);
    return height < 0 ? r - 2 * height * facet : r;
}

} // namespace bake
