// What an engine needs of a sky: the levels of its ladder, irradiance, spherical harmonics.
#pragma once
#include "bake/environment/engine/sh_text.h"
#include <optional>

namespace bake {

class Progress;

struct EngineOptions {
    Consumer consumer = Consumer::three; ///< one that loads levels
    int size = 0; ///< texels along an edge of level 0, a power of two; 0: the engine's usual number, at most
                  ///< the power of two below the sky's
    std::optional<TexelFormat> texels; ///< rgb9e5, rgba16f or bc6h; none: the engine's
    bool levels_as_files = false;      ///< each level a cube map of its own
    bool whole_set = true;             ///< the skybox, irradiance, coefficients and DFG table too
};

/// Texels along an edge of level 0. `sky_edge`: of the sky. Throws as roughness_ladder().
int engine_edge(const EngineOptions& options, int sky_edge);

struct EngineLevels {
    std::vector<Cube> levels;      ///< three channels, in cube space; after level 0 by interpolated_best()
    std::vector<double> roughness; ///< alpha of each
    std::vector<Cube> skybox; ///< the sky with plain mips, down to one texel; empty unless the whole set is asked for
    Cube irradiance;          ///< divided by pi, 32 texels along an edge, by interpolated_best(); likewise
    ShCoefficients sh;
};

/// `sky`: finite, of any size and number of channels; grey becomes three channels, alpha is left out.
EngineLevels engine_levels(Cube sky, const EngineOptions& options, Progress* progress = nullptr);

/// The sky in a mirror at x = 0: what a program shows that looks up directions of the world as they are.
Cube mirrored_x(const Cube& sky);

} // namespace bake
