#include "bake/preview/material_entry.h"
#include "bake/base/error.h"
#include "bake/base/progress.h"
#include "bake/preview/texture_size.h"

namespace bake {
namespace {

template <class Read> Texture cached(TextureCache& cache, const std::string& key, Read&& read) {
    throw_if_interrupted();
    Texture& texture = cache[key];
    if (!texture) texture = read();
    return texture;
}

// Textures that are not reduced share the names of load_maps().
std::string reduced_to(int size) { return size > 0 ? std::to_string(size) + " " : std::string(); }

Texture load_normal_map(const MaterialEntry& entry, TextureCache& cache, const LoadedPictures& known,
                        std::vector<std::string>& notes) {
    const std::string key = reduced_to(entry.relief_size) + (entry.normal_bc5 ? "bc5 " : "") +
                            (entry.directx ? "directx " : "opengl ") + std::to_string(int(entry.encoding)) + " " +
                            entry.normal_map;
    return cached(cache, key, [&] {
        const Texture map = normals_halved_to(
            read_normal_map(entry.normal_map, entry.encoding, entry.directx, &notes, known), entry.relief_size);
        return entry.normal_bc5 ? normals_in_bc5(map) : map;
    });
}

/// The textures besides albedo and normal. Null if there are none.
std::shared_ptr<const SurfaceMaps> load_maps(const MaterialEntry& entry, TextureCache& cache,
                                             std::vector<std::string>& notes) {
    SurfaceMaps maps;
    bool any = false;
    const auto read_map = [&](const std::string& file, bool colour, SurfaceMap& to) {
        if (file.empty()) return;
        const ColourSpace space = colour ? ColourSpace::automatic : ColourSpace::linear;
        to.texture = cached(cache, "albedo " + std::to_string(int(space)) + " " + file,
                            [&] { return read_albedo(file, space, &notes); });
        any = true;
    };
    read_map(entry.specular_map, true, maps.specular);
    read_map(entry.emission_map, true, maps.emission);
    read_map(entry.shininess_map, false, maps.shininess);
    read_map(entry.roughness_map, false, maps.roughness);
    read_map(entry.metallic_map, false, maps.metallic);
    read_map(entry.occlusion_map, false, maps.occlusion);
    if (entry.alpha_cutoff) {
        maps.alpha.texture = read_alpha(entry.albedo);
        if (!maps.alpha)
            throw Error(Refusal::unsuitable,
                        entry.albedo + ": is opaque, and \"alpha-cutoff\" needs its alpha; remove the key");
        maps.alpha_mode = AlphaMode::mask, maps.alpha_cutoff = *entry.alpha_cutoff;
        any = true;
    }
    return any ? std::make_shared<const SurfaceMaps>(std::move(maps)) : nullptr;
}

} // namespace

std::unique_ptr<Material> load_material(const MaterialEntry& entry, TextureCache& cache, const LoadedPictures& known,
                                        std::vector<std::string>& notes) {
    if (entry.relief.file.empty() && entry.relief.shade && entry.relief.shade->shade != Shade::plain)
        throw Error(Refusal::unreadable, "\"shade\" shows a height, and there is none; add height = {file = ...}");
    auto material = std::make_unique<Material>();
    material->name = entry.name;
    material->reflectance = entry.reflectance;
    material->reflect = entry.reflect;
    if (!entry.albedo.empty())
        material->albedo = cached(
            cache,
            reduced_to(entry.albedo_size) + "albedo " + std::to_string(int(entry.albedo_space)) + " " + entry.albedo,
            [&] { return halved_to(read_albedo(entry.albedo, entry.albedo_space, &notes, known), entry.albedo_size); });
    if (!entry.bump_table.empty())
        material->bump_table = cached(
            cache, reduced_to(entry.relief_size) + "bump " + std::to_string(entry.bump_scale) + " " + entry.bump_table,
            [&] {
                return halved_to(read_bump_table(entry.bump_table, entry.bump_scale, &notes, known), entry.relief_size);
            });
    if (!entry.normal_map.empty()) material->normal_map = load_normal_map(entry, cache, known, notes);
    material->maps = load_maps(entry, cache, notes);
    return material;
}

} // namespace bake
