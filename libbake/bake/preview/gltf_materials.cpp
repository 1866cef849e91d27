#include "bake/preview/gltf_materials.h"
#include "bake/base/text.h"
#include "bake/base/text_line.h"
#include <algorithm>

namespace bake {
namespace {

MapWrap wrap_of(int code) noexcept {
    return code == 33071 ? MapWrap::clamp : code == 33648 ? MapWrap::mirror : MapWrap::repeat;
}

/// Reads one material.
struct Reader {
    const GltfMaterial& from;
    const GltfCharts& charts;
    const Mesh& mesh;
    GltfImages& images;
    const std::string& path;
    std::vector<std::string>& notes;

    void note(const std::string& what) const {
        notes.push_back(path + ": material " + (from.name.empty() ? "without name" : shown(from.name)) + ": " + what);
    }

    /// The factor, within its range.
    float checked(const char* name, float value, float low, float high) const {
        if (value >= low && value <= high) return value;
        const float taken = value > high ? high : low; // low for NaN
        note(format("%s is %g; %g is taken", name, double(value), double(taken)));
        return taken;
    }

    Vec3f checked(const char* name, const Vec3f& value) const {
        return {checked(name, value.x, 0, 1), checked(name, value.y, 0, 1), checked(name, value.z, 0, 1)};
    }

    bool can_show(const std::optional<GltfTexture>& texture) const {
        return texture && texture->image != no_index && !mesh.corner_uv.empty();
    }

    SurfaceMap map(const std::optional<GltfTexture>& from_texture, Texture texture) const {
        SurfaceMap out{.texture = std::move(texture)};
        if (!out) return out;
        const GltfSampler& sampler = from_texture->sampler;
        out.uvs = charts.number_of(*from_texture) - 1;
        out.wrap_u = wrap_of(sampler.wrap_u), out.wrap_v = wrap_of(sampler.wrap_v);
        out.nearest = sampler.mag_filter == 9728;
        return out;
    }

    void read_factors(Material& to, SurfaceMaps& maps) const {
        Reflectance& r = to.reflectance;
        r.model = Reflectance::Model::ggx;
        r.diffuse = r.ambient = checked("baseColorFactor", Vec3f(from.base_color_factor));
        r.metallic = checked("metallicFactor", from.metallic, 0, 1);
        r.roughness = checked("roughnessFactor", from.roughness, 0, 1);
        r.emission = checked("emissiveFactor", from.emissive_factor) * from.emissive_strength;
        maps.opacity = checked("baseColorFactor", from.base_color_factor.w, 0, 1);
        maps.unlit = from.unlit;
        maps.one_sided = !from.double_sided;
    }

    void read_textures(Material& to, SurfaceMaps& maps) const {
        if (can_show(from.base_color)) maps.base = map(from.base_color, images.colour(from.base_color->image));
        if (from.unlit) return;
        if (can_show(from.metallic_roughness))
            maps.roughness = maps.metallic = map(from.metallic_roughness, images.data(from.metallic_roughness->image));
        if (can_show(from.emissive)) maps.emission = map(from.emissive, images.colour(from.emissive->image));
        if (can_show(from.occlusion)) {
            maps.occlusion = map(from.occlusion, images.data(from.occlusion->image));
            maps.occlusion_strength = checked("the strength of the occlusion", float(from.occlusion->scale), 0, 1);
        }
        if (can_show(from.normal)) {
            const float scale = checked("the scale of the normal texture", float(from.normal->scale), -1e6f, 1e6f);
            to.normal_map = images.normals(from.normal->image, scale);
        }
    }

    void read_alpha(SurfaceMaps& maps) const {
        if (from.alpha_mode == "OPAQUE") return;
        if (can_show(from.base_color)) maps.alpha = map(from.base_color, images.alpha(from.base_color->image));
        const bool colours =
            maps.vertex_colours >= 0 && mesh.attributes[std::size_t(maps.vertex_colours)].components == 4;
        if (!maps.alpha && !colours && from.alpha_mode == "BLEND" && maps.opacity == 1) return; // opaque
        maps.alpha_mode = from.alpha_mode == "MASK" ? AlphaMode::mask : AlphaMode::blend;
        if (maps.alpha_mode == AlphaMode::mask) maps.alpha_cutoff = checked("alphaCutoff", from.alpha_cutoff, 0, 1e6f);
        else
            note("is blended: each ray passes it by chance, with the probability 1 - alpha; take 16 samples per pixel "
                 "or more");
    }

    /// Textures that are left out.
    void note_textures() const {
        bool any = false, unread = false;
        for (const auto* texture :
             {&from.normal, &from.base_color, &from.metallic_roughness, &from.emissive, &from.occlusion}) {
            any = any || *texture;
            unread = unread || (*texture && (*texture)->image == no_index);
        }
        if (any && mesh.corner_uv.empty()) note("has textures, but its faces have no uvs; it is shown without them");
        else if (unread) note("has a texture in a format that is not read here; it is shown without it");
    }
};

} // namespace

std::unique_ptr<Material> make_material(const GltfMaterial& from, const GltfCharts& charts, const Mesh& mesh,
                                        GltfImages& images, const std::string& path, std::vector<std::string>& notes) {
    const Reader reader{from, charts, mesh, images, path, notes};
    auto material = std::make_unique<Material>();
    material->name = from.name;
    SurfaceMaps maps;
    for (std::size_t i = 0; i < mesh.attributes.size(); ++i)
        if (mesh.attributes[i].name == "COLOR_0") maps.vertex_colours = int(i);
    reader.read_factors(*material, maps);
    reader.read_textures(*material, maps);
    reader.read_alpha(maps);
    reader.note_textures();
    material->maps = std::make_shared<const SurfaceMaps>(std::move(maps));
    return material;
}

} // namespace bake
