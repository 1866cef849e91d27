// The programs that load what bake writes: what each of them expects of a normal map, of the levels of a filtered sky, and of
// a lat-long picture of the sky.
//
// Normal maps:
//   unreal    "Recommended Asset Naming Conventions" (T_ and the suffix _N), "Texture Format Support and Settings" (sizes;
//             normal maps are DirectX's).
//   unity     manual, "Importing a normal map" (OpenGL's), "Texture import settings" (Non-Power of 2: scaled to the nearest
//             by default).
//   godot     manual, "Standard Material 3D" (OpenGL's).
//   blender   manual, "Normal Map Node" (OpenGL's; 16 bits are read as they are).
//   three     MeshStandardMaterial.normalMap (OpenGL's; browsers decode 8 bits).
//   substance "Project settings: normal map format", whose default is DirectX, and exports of 16 bits.
//
// Levels: level l of n holds the sky filtered with GGX of the width alpha = r^2, r the roughness of artists. Which r belongs to
// which level is agreed between the file and the shader that reads it (roughness_ladder()):
//   three     r = 1 - sqrt(1 - l / (n - 1)), the last level has 8 x 8 texels per face, and diffuse surfaces read it too:
//             PMREMGenerator.lodToRoughness() and LOD_MIN of three.js r187. Directions are looked up with x negated.
//   filament  the same rule; the last level has 16 x 16 texels: lodToPerceptualRoughness() and --ibl-min-lod-size of
//             Filament's cmgen 1.9.25, perceptualRoughnessToLod() of its surface_light_indirect.fs. Directions are looked
//             up as they are, so that faces are mirrored (cmgen mirrors them too). KTX of version 1, by its Ktx1Reader.
//   bevy      r = l / (n - 1): radiance_level of bevy_pbr's environment_map.wgsl, for any n; ours ends at 16 x 16 texels.
//             Irradiance over pi in a cube of its own. Directions are looked up with z negated.
//   babylon   alpha = 2^(l / 0.8) / (texels along an edge): getLodFromAlphaG() and lodGenerationScale of Babylon.js,
//             HDRFiltering; all levels down to one texel. Irradiance is computed from level 0 when the file is loaded.
// Negating x or z both give the cube space of conventions.md, turned by half a turn about y: the sky ahead of bake lies at
// +z of the world in three and Filament, and at -z, ahead of its camera, in bevy.
//
// Lat-longs: none is mirrored. What differs is the direction in the middle, told here in the axes of a glTF file as the
// program imports it:
//   three     +X: equirectUv() of its shaders: u = atan(z, x) / 2 pi + 1/2.
//   blender   +X: Cycles' direction_to_equirectangular(): u = 1/2 - atan2(y, x) / 2 pi, z up; its glTF importer keeps x.
//   godot     +Z: sky.glsl: u = atan(x, -z) / 2 pi.
//   unity     +Z of a cube map that is imported from a lat-long: latlong functions of its render pipelines' Common.hlsl, "(-Z,
//             X)". The importer itself is not public. glTFast negates x, so that its axes are those of cube space.
//   unreal    -Z, which it calls -Y: LookupLongLat of TextureCompressorModule.cpp: u = (1 + atan2(x, -y) / pi) / 2, z up; a
//             glTF's (x, y, z) becomes (x, z, y).
//   substance -X: envSampleLOD() of Painter's lib-env.glsl: u = atan(-z, -x) / 2 pi + 1/2 + environment_rotation.
#pragma once
#include "bake/picture/image_types.h"
#include "bake/picture/texture_level.h"
#include <optional>

namespace bake {

enum class Consumer { three, bevy, babylon, filament, godot, unreal, unity, blender, substance };

/// How nine coefficients of spherical harmonics are scaled.
enum class ShForm {
    irradiance, ///< E(n) = sum of E_lm Y_lm(n)
    radiance,   ///< L_lm, which three.js' LightProbe multiplies by the factors of the cosine itself
    filament, ///< irradiance over pi, times the constants of Y_lm: factors of y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2
};

struct NormalMapRule {
    bool directx = false;    ///< green points down
    Depth depth = Depth::u8; ///< of a PNG
    const char* before = ""; ///< the stem, in the names of normal maps
    const char* after = "";  ///< the stem
    /// What happens to a map whose sides are no powers of two, in a message that may name `size`; null: nothing.
    const char* odd_size = nullptr;
};

/// A sky that is filtered before the program loads it.
struct LevelsRule {
    const char* ending = ""; ///< of its files in a folder
    TexelFormat texels = TexelFormat::rgba16f;
    int edge = 0;       ///< texels along an edge of level 0, unless the caller names another number
    int least_edge = 0; ///< of the last level
    bool mirrored = false;
    ShForm sh = ShForm::irradiance;
};

/// A sky that the program filters itself, or shows as it is.
struct LatlongRule {
    const char* ending = ""; ///< of its file in a folder
    /// Yaw from bake's lat-long, which has +Z of the world in its middle, to the program's, in quarter turns.
    int quarter_turns = 0;
};

/// What a program does not load, or what is not known, is empty.
struct ConsumerEntry {
    Consumer consumer;
    const char* name;
    std::optional<NormalMapRule> normal_map;
    std::optional<LevelsRule> levels;
    std::optional<LatlongRule> latlong;
};

inline constexpr ConsumerEntry consumers[] = {
    {Consumer::three, "three", NormalMapRule{.after = "_normal"},
     LevelsRule{".dds", TexelFormat::bc6h, 512, 8, false, ShForm::radiance}, LatlongRule{".hdr", 1}},
    {Consumer::bevy, "bevy", {}, LevelsRule{".ktx2", TexelFormat::rgb9e5, 512, 16}, {}},
    {Consumer::babylon, "babylon", {}, LevelsRule{".dds", TexelFormat::rgba16f, 256, 1}, {}},
    {Consumer::filament, "filament", {}, LevelsRule{".ktx", TexelFormat::rgba16f, 256, 16, true, ShForm::filament}, {}},
    {Consumer::godot, "godot", NormalMapRule{.after = "_normal"}, {}, LatlongRule{".exr", 0}},
    {Consumer::unreal,
     "unreal",
     NormalMapRule{true, Depth::u8, "T_", "_N",
                   "Unreal makes no mips of such a texture and does not stream it; give `size` a power of two"},
     {},
     LatlongRule{".hdr", 2}},
    {Consumer::unity,
     "unity",
     NormalMapRule{
         false, Depth::u8, "", "_Normal",
         "Unity scales it to the nearest power of two on import; give `size` one, or set Non-Power of 2 to None"},
     {},
     LatlongRule{".exr", 0}},
    {Consumer::blender, "blender", NormalMapRule{false, Depth::u16, "", "_normal"}, {}, LatlongRule{".exr", 1}},
    {Consumer::substance,
     "substance",
     NormalMapRule{true, Depth::u16, "", "_normal",
                   "Substance works in powers of two and resamples it; give `size` one"},
     {},
     LatlongRule{".exr", -1}},
};

constexpr const ConsumerEntry& entry_of(Consumer consumer) noexcept { return consumers[int(consumer)]; }

/// The axis of the world, as glTF has it, in the middle of the program's lat-longs: "+X".
constexpr const char* middle_axis(const LatlongRule& rule) noexcept {
    constexpr const char* axes[] = {"+Z", "+X", "-Z", "-X"};
    return axes[rule.quarter_turns & 3];
}

} // namespace bake
