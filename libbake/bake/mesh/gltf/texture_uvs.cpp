// Where what is baked for a glTF will be sampled: the sets of uvs and the transforms of its textures.
#include "bake/base/error.h"
#include "bake/base/text_line.h"
#include "bake/mesh/gltf/io.h"
#include "bake/mesh/uv_set.h"
#include <cmath>

namespace bake {
namespace {

/// "brick", or "brick and 2 other materials".
std::string material_list(const std::vector<std::string>& names) {
    const std::string others = std::to_string(names.size() - 1);
    return shown(names[0]) + (names.size() == 1   ? ""
                              : names.size() == 2 ? " and 1 other material"
                                                  : " and " + others + " other materials");
}

/// Adds notes on the materials that have faces.
void add_notes(const std::vector<GltfTextureUvs>& of_material, const std::vector<bool>& used, bool chosen, Gltf& gltf) {
    std::vector<std::string> on_other_set, transformed;
    int set = 0;
    for (std::size_t m = 0; m < of_material.size(); ++m) {
        if (!used[m]) continue;
        const std::string& name = m < gltf.mesh.materials.size() ? gltf.mesh.materials[m] : "none";
        if (of_material[m].set != 0) on_other_set.push_back(name), set = std::max(set, of_material[m].set);
        if (of_material[m].moves()) transformed.push_back(name);
    }
    if (!chosen && !on_other_set.empty())
        gltf.notes.push_back("the textures of " + material_list(on_other_set) + " lie on TEXCOORD_" +
                             std::to_string(set) + ": its uvs are taken (`uv_set` chooses a set)");
    if (!transformed.empty())
        gltf.notes.push_back("KHR_texture_transform of " + material_list(transformed) + " is applied to the uvs");
}

} // namespace

GltfTextureUvs texture_uvs(const GltfMaterial& m, int set) {
    GltfTextureUvs out{std::max(0, set), {}};
    const auto first = [](const std::optional<GltfTexture>& texture) { return texture ? int(texture->uv_set) : -1; };
    for (const auto* texture : {&m.normal, &m.base_color, &m.metallic_roughness})
        if (set < 0 && *texture) {
            set = out.set = first(*texture);
            break;
        }
    for (const auto* texture : {&m.normal, &m.base_color, &m.metallic_roughness, &m.emissive, &m.occlusion})
        if (first(*texture) == out.set) {
            out.transform = (*texture)->transform;
            break;
        }
    return out;
}

Vec2f transformed(const GltfTransform& t, const Vec2f& uv, bool flip_v) noexcept {
    const double u = t.scale_u * double(uv.x), v = t.scale_v * (flip_v ? 1 - double(uv.y) : double(uv.y));
    const double c = std::cos(t.rotation), s = std::sin(t.rotation);
    const double moved_u = c * u + s * v + t.offset_u, moved_v = c * v - s * u + t.offset_v;
    return Vec2f(Vec2d(moved_u, flip_v ? 1 - moved_v : moved_v));
}

void take_texture_uvs(Gltf& gltf, const std::string& path, const GltfUvOptions& options) {
    Mesh& mesh = gltf.mesh;
    const bool chosen = options.uv_set >= 0;
    if (chosen && !has_uv_set(mesh, options.uv_set)) take_uv_set(mesh, options.uv_set, path); // refuses
    std::vector<GltfTextureUvs> of_material; // and, at the end, of faces without a material
    for (const GltfMaterial& material : gltf.materials) of_material.push_back(texture_uvs(material, options.uv_set));
    of_material.push_back({std::max(0, options.uv_set), {}});
    std::vector<bool> used(of_material.size());
    std::vector<std::size_t> face_uvs(mesh.faces(), of_material.size() - 1);
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        if (!mesh.face_material.empty() && mesh.face_material[f] < gltf.materials.size())
            face_uvs[f] = mesh.face_material[f];
        used[face_uvs[f]] = true;
    }
    for (std::size_t m = 0; m < of_material.size(); ++m)
        if (used[m] && of_material[m].set != 0 && !has_uv_set(mesh, of_material[m].set)) {
            gltf.notes.push_back("the textures of " + material_list({mesh.materials[m]}) + " lie on TEXCOORD_" +
                                 std::to_string(of_material[m].set) + ", which is missing: TEXCOORD_0 is taken");
            of_material[m] = {};
        }
    std::vector<int> face_set;
    bool changes = false;
    for (const std::size_t m : face_uvs) {
        face_set.push_back(of_material[m].set);
        changes = changes || of_material[m].set != 0 || of_material[m].moves();
    }
    if (!changes || (mesh.corner_uv.empty() && uv_set_names(mesh) == "none")) return;
    add_notes(of_material, used, chosen, gltf);
    CornerUvs corners = exchange_uv_sets(mesh, face_set);
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const GltfTextureUvs& uvs = of_material[face_uvs[f]];
        if (!uvs.moves()) continue;
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            if (corners.has[c]) corners.uv[c] = transformed(uvs.transform, corners.uv[c], options.flip_v);
    }
    set_corner_uvs(mesh, corners);
    for (const Vec2f& uv : mesh.uvs)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
            throw Error(Refusal::unreadable,
                        path + ": its KHR_texture_transform moves uvs beyond all floats; export the file again");
}

} // namespace bake
