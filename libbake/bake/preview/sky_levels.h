// The light of a sky as real-time engines keep it: irradiance, and levels filtered for gloss. Nothing shadows this light.
//
// Computed by environment/filter, or read from files that bake cubemap has written, which can thus be judged.
#pragma once
#include "bake/light/lobe.h"
#include "bake/preview/sky.h"
#include <string>

namespace bake {

struct SkyLevels {
    Cube irradiance;           ///< radiance times steradian, pi for a white sky
    std::vector<Cube> glossy;  ///< of three channels, filtered with ggx lobes; an empty one is the sky itself
    std::vector<float> alphas; ///< of each, ascending
    bool own_irradiance = false, own_glossy = false; ///< computed by complete(), for one sky
    bool empty() const noexcept { return irradiance.empty() && glossy.empty(); }
};

/// Computes what is empty, and again what it has computed, from a sky that is not empty. Faces are as small as the width of each lobe allows.
void complete(SkyLevels& levels, const Cube& sky);

/// Reads irradiance from one input of read_environment(). Throws as that.
Cube read_irradiance(const std::string& file);
/// Reads as many levels as there are alphas, of six .exr files with mip levels, named by a pattern with %s, or of a cube map
/// as read_cube_levels(). Throws Error{Refusal::unreadable} for other files, and Error{Refusal::unsuitable} if they have
/// fewer levels.
std::vector<Cube> read_glossy(const std::string& file, std::size_t levels);

/// The light of the sky that a surface reflects to the viewer; `sky` gives scale and rotation. Complete levels; unit vectors
/// as for evaluate().
BsdfValue reflected(const SkyLevels& levels, const Sky& sky, const Bsdf& bsdf, const Vec3f& n, const Vec3f& v) noexcept;

} // namespace bake
