#include "bake/mesh/gltf/extensions.h"
#include "bake/base/error.h"
#include "bake/base/text_line.h"
#include <algorithm>

namespace bake {
namespace {

struct Compression {
    const char *extension, *program;
};
constexpr Compression compressions[] = {{"KHR_draco_mesh_compression", "Draco"},
                                        {"EXT_meshopt_compression", "meshoptimizer"},
                                        {"KHR_meshopt_compression", "meshoptimizer"}};

/// Applied by this module.
constexpr const char* applied[] = {"KHR_mesh_quantization", "KHR_texture_transform", "EXT_mesh_gpu_instancing",
                                   "KHR_node_visibility"};

/// They change how a mesh looks, or what a program does with it, but not the mesh and not its uvs.
constexpr const char* harmless[] = {"KHR_lights_punctual",
                                    "EXT_lights_ies",
                                    "EXT_lights_image_based",
                                    "KHR_texture_basisu",
                                    "KHR_xmp",
                                    "KHR_xmp_json_ld",
                                    "KHR_animation_pointer",
                                    "KHR_node_selectability",
                                    "KHR_node_hoverability",
                                    "KHR_interactivity",
                                    "KHR_physics_rigid_bodies",
                                    "KHR_audio_emitter"};
constexpr const char* harmless_kinds[] = {"KHR_materials_", "EXT_materials_", "ADOBE_materials_", "EXT_texture_",
                                          "MSFT_texture_"};

template <class List> bool lists(const List& list, const std::string& name) {
    return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

bool is_known(const std::string& name) {
    return lists(applied, name) || lists(harmless, name) ||
           std::any_of(std::begin(harmless_kinds), std::end(harmless_kinds),
                       [&](const char* kind) { return name.rfind(kind, 0) == 0; });
}

const Compression* compression(const std::string& name) {
    const auto found = std::find_if(std::begin(compressions), std::end(compressions),
                                    [&](const Compression& c) { return name == c.extension; });
    return found == std::end(compressions) ? nullptr : found;
}

} // namespace

void refuse_compression(const std::string& extension, const std::string& path) {
    const Compression* const known = compression(extension);
    throw Error(Refusal::unsuitable, path + ": its meshes are compressed by " + shown(extension) +
                                         (known ? std::string(" (") + known->program + ")" : std::string()) +
                                         ", which is not read here; export it without compression");
}

void refuse_unknown_extensions(const std::vector<std::string>& required, const std::string& path) {
    for (const std::string& name : required)
        if (compression(name)) refuse_compression(name, path);
    for (const std::string& name : required)
        if (!is_known(name))
            throw Error(Refusal::unsuitable, path + ": requires the extension " + shown(name) +
                                                 ", which is not known here; export it without the extension");
}

} // namespace bake
