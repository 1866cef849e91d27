// The programs that load environments, and the rules by which each of them reads the levels of a filtered sky.
//
// A level l of n holds the sky filtered with GGX of the width alpha = r^2, r the roughness of artists. Which r belongs to
// which level is agreed between the file and the shader that reads it:
//
//   three     r = 1 - sqrt(1 - l / (n - 1)), the last level has 8 x 8 texels per face, and diffuse surfaces read it too:
//             PMREMGenerator.lodToRoughness() and LOD_MIN of three.js r187. Directions are looked up with x negated.
//   filament  the same rule; the last level has 16 x 16 texels: lodToPerceptualRoughness() and --ibl-min-lod-size of
//             Filament's cmgen 1.9.25, perceptualRoughnessToLod() of its surface_light_indirect.fs. Directions are looked
//             up as they are, so that faces are mirrored (cmgen mirrors them too). KTX of version 1, by its Ktx1Reader.
//   bevy      r = l / (n - 1): radiance_level of bevy_pbr's environment_map.wgsl, for any n; ours ends at 16 x 16 texels.
//             Irradiance over pi in a cube of its own. Directions are looked up with z negated.
//   babylon   alpha = 2^(l / 0.8) / (texels along an edge): getLodFromAlphaG() and lodGenerationScale of Babylon.js,
//             HDRFiltering; all levels down to one texel. Irradiance is computed from level 0 when the file is loaded.
//   godot     filters the sky itself: PanoramaSkyMaterial takes a lat-long picture.
//   unreal    filters the sky itself: a .hdr lat-long picture becomes a cube texture.
//
// Negating x or z both give the cube space of conventions.md, turned by half a turn about y: the sky ahead of bake lies at
// +z of the world in three and Filament, and at -z, ahead of its camera, in bevy.
#pragma once
#include "bake/picture/texture_level.h"
#include <optional>
#include <string>
#include <vector>

namespace bake {

enum class Consumer { three, bevy, babylon, filament, godot, unreal };

/// How nine coefficients of spherical harmonics are scaled.
enum class ShForm {
    irradiance, ///< E(n) = sum of E_lm Y_lm(n)
    radiance,   ///< L_lm, which three.js' LightProbe multiplies by the factors of the cosine itself
    filament, ///< irradiance over pi, times the constants of Y_lm: factors of y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2
};

struct ConsumerEntry {
    Consumer consumer;
    const char* name;
    bool prefiltered = false; ///< false: it loads a lat-long picture and filters it itself
    const char* ending = "";  ///< of its files in a folder
    TexelFormat texels = TexelFormat::rgba16f;
    int edge = 0;       ///< texels along an edge of level 0, unless the caller names another number
    int least_edge = 0; ///< of the last level
    bool mirrored = false;
    ShForm sh = ShForm::irradiance;
};

inline constexpr ConsumerEntry consumers[] = {
    {Consumer::three, "three", true, ".dds", TexelFormat::bc6h, 512, 8, false, ShForm::radiance},
    {Consumer::bevy, "bevy", true, ".ktx2", TexelFormat::rgb9e5, 512, 16},
    {Consumer::babylon, "babylon", true, ".dds", TexelFormat::rgba16f, 256, 1},
    {Consumer::filament, "filament", true, ".ktx", TexelFormat::rgba16f, 256, 16, true, ShForm::filament},
    {Consumer::godot, "godot", false, ".exr"},
    {Consumer::unreal, "unreal", false, ".hdr"},
};

constexpr const ConsumerEntry& entry_of(Consumer consumer) noexcept { return consumers[int(consumer)]; }

/// alpha of every level, level 0 first, which is 0: the sky itself. `edge`: a power of two, at least twice the last level's.
/// Empty for a consumer that filters the sky itself. Throws Error{Refusal::usage} for another `edge`.
std::vector<double> roughness_ladder(Consumer consumer, int edge);

} // namespace bake
