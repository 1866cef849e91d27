#include "bake/preview/gltf_charts.h"
#include "bake/base/error.h"
#include "bake/mesh/mesh_corner.h"
#include "bake/mesh/uv_set.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

const Attribute* attribute_named(const Mesh& mesh, const std::string& name, int least, int most) {
    for (const Attribute& a : mesh.attributes)
        if (a.name == name && a.components >= least && a.components <= most) return &a;
    return nullptr;
}

/// The uvs of a set, moved by the transform. Set 0 if the mesh has no other.
CornerUvs chart_uvs(const Mesh& mesh, std::uint32_t set, const GltfTransform& transform, bool flip_v) {
    CornerUvs out{std::vector<Vec2f>(mesh.corners()), std::vector<bool>(mesh.corners(), true)};
    const Attribute* const other = set == 0 ? nullptr : attribute_named(mesh, "TEXCOORD_" + std::to_string(set), 2, 2);
    for (std::uint32_t c = 0; c < mesh.corners(); ++c) {
        if (other) {
            const float* const uv = &other->values[2 * std::size_t(c)];
            out.uv[c] = {uv[0], uv[1]};
        } else {
            out.has[c] = !mesh.corner_uv.empty() && mesh.corner_uv[c] != no_index;
            out.uv[c] = uv_at(mesh, c);
        }
        if (out.has[c]) out.uv[c] = transformed(transform, out.uv[c], flip_v);
    }
    return out;
}

} // namespace

GltfCharts::GltfCharts(const GltfMaterial& m) {
    for (const auto* texture : {&m.normal, &m.base_color, &m.metallic_roughness, &m.emissive, &m.occlusion}) {
        if (!*texture) continue;
        const Chart chart{(*texture)->uv_set, (*texture)->transform};
        if (std::find(charts_.begin(), charts_.end(), chart) == charts_.end()) charts_.push_back(chart);
    }
}

int GltfCharts::number_of(const GltfTexture& texture) const noexcept {
    const auto found = std::find(charts_.begin(), charts_.end(), Chart{texture.uv_set, texture.transform});
    return int(found - charts_.begin());
}

std::vector<std::uint32_t> GltfCharts::apply(Mesh& mesh, bool flip_v, const std::string& path) const {
    std::vector<std::uint32_t> missing;
    std::vector<Attribute> attributes;
    CornerUvs first;
    for (const Chart& chart : charts_) {
        if (chart.set != 0 && !attribute_named(mesh, "TEXCOORD_" + std::to_string(chart.set), 2, 2))
            missing.push_back(chart.set);
        CornerUvs uvs = chart_uvs(mesh, chart.set, chart.transform, flip_v);
        for (const Vec2f& uv : uvs.uv)
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
                throw Error(Refusal::unreadable,
                            path + ": its KHR_texture_transform moves uvs beyond all floats; export the file again");
        if (&chart == charts_.data()) {
            first = std::move(uvs);
            continue;
        }
        Attribute& values = attributes.emplace_back(Attribute{"chart", 2, {}});
        values.values.reserve(2 * uvs.uv.size());
        for (const Vec2f& uv : uvs.uv) values.values.push_back(uv.x), values.values.push_back(uv.y);
    }
    const Attribute* const colours = attribute_named(mesh, "COLOR_0", 3, 4);
    const auto coloured = [](float value) { return value != 1; };
    if (colours && std::any_of(colours->values.begin(), colours->values.end(), coloured))
        attributes.push_back(*colours);
    if (!keeps_tangents()) set_corner_uvs(mesh, first);
    mesh.attributes = std::move(attributes);
    return missing;
}

} // namespace bake
