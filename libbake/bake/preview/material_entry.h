// A material of a scene file, and the function that loads its textures.
#pragma once
#include "bake/preview/material.h"
#include "bake/preview/relief_entry.h"
#include <map>
#include <optional>

namespace bake {

struct MaterialEntry {
    std::string name;
    Reflectance reflectance;
    Vec3f reflect{0};
    std::string albedo, bump_table, normal_map; ///< files; empty if not given
    std::string specular_map, shininess_map, roughness_map, metallic_map, occlusion_map, emission_map; ///< likewise
    std::optional<float> alpha_cutoff; ///< rays pass where the alpha of the albedo is below it
    ColourSpace albedo_space = ColourSpace::automatic;
    float bump_scale = 1;
    NormalEncoding encoding = NormalEncoding::automatic;
    bool directx = false;
    int albedo_size = 0;     ///< most texels along an edge of the albedo, see halved_to(); 0: as it is
    int relief_size = 0;     ///< the same of the bump table or normal map, be it a file or baked for `relief`
    bool normal_bc5 = false; ///< the normal map, be it a file or baked for `relief`, is shown as BC5 blocks store it
    ReliefEntry relief;
    Vec2f repeat{1}; ///< how often the textures repeat over the unit square of uvs
    int line = 0;    ///< line in the scene file, for messages
};

/// Textures by their file and all options of reading, so that materials share them.
using TextureCache = std::map<std::string, Texture>;

/// Without its relief, which is baked for a shape. Reads what `cache` and `known` do not have. `notes` receives what reading
/// the files has to tell. Throws the errors of the readers, and Error{Refusal::unsuitable} for an alpha-cutoff of an opaque
/// albedo.
std::unique_ptr<Material> load_material(const MaterialEntry& entry, TextureCache& cache, const LoadedPictures& known,
                                        std::vector<std::string>& notes);

} // namespace bake
