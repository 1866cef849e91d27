#include "inputs/engine.h"
#include "bake/base/text.h"
#include <bit>
#include <filesystem>

namespace bake {
namespace {

// Unreal: "Recommended Asset Naming Conventions" (T_ and the suffix _N), "Texture Format Support and Settings" (sizes;
// normal maps are DirectX's). Unity: manual, "Importing a normal map" (OpenGL's), "Texture import settings" (Non-Power of 2:
// scaled to the nearest by default). Godot: manual, "Standard Material 3D" (OpenGL's). Blender: manual, "Normal Map Node"
// (OpenGL's; 16 bits are read as they are). three.js: MeshStandardMaterial.normalMap (OpenGL's; browsers decode 8 bits).
// Substance: "Project settings: normal map format", whose default is DirectX, and exports of 16 bits.
constexpr Engine engines[] = {
    {"unreal", true, Depth::u8, "T_", "_N",
     "Unreal makes no mips of such a texture and does not stream it; give --size a power of two"},
    {"unity", false, Depth::u8, "", "_Normal",
     "Unity scales it to the nearest power of two on import; give --size one, or set Non-Power of 2 to None"},
    {"godot", false, Depth::u8, "", "_normal", nullptr},
    {"blender", false, Depth::u16, "", "_normal", nullptr},
    {"three", false, Depth::u8, "", "_normal", nullptr},
    {"substance", true, Depth::u16, "", "_normal",
     "Substance works in powers of two and resamples it; give --size one"},
};

} // namespace

void add_engine_option(CLI::App& sub, EngineChoice& engine) {
    std::vector<std::string> names;
    for (const Engine& known : engines) names.emplace_back(known.name);
    std::string listed;
    for (const std::string& name : names) listed += (listed.empty() ? "" : "|") + name;
    sub.add_option_function<std::string>(
           "--for",
           [&engine](const std::string& name) {
               for (const Engine& known : engines)
                   if (name == known.name) engine = &known;
           },
           "What loads the map: sets green and the depth of a .png, and with -o FOLDER/ the name of the file")
        ->check(CLI::IsMember(names).description(""))
        ->type_name(listed);
}

bool names_folder(const std::string& out) { return out.ends_with('/') || std::filesystem::is_directory(out); }

std::string normal_map_name(const Engine& engine, const std::string& folder, const std::string& stem) {
    return (std::filesystem::path(folder) / (engine.before + stem + engine.after + ".png")).string();
}

std::string size_note(const Engine& engine, int width, int height) {
    const bool powers = std::has_single_bit(unsigned(width)) && std::has_single_bit(unsigned(height));
    return powers || !engine.odd_size ? "" : format("%d x %d: ", width, height) + engine.odd_size;
}

} // namespace bake
