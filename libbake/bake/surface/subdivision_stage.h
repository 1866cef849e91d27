// The surface in pieces: stages of splitting by OpenSubdiv's Far, whose patches become leaves. Within its room only.
//
// One stage goes down ten levels at most, as deep as Far's patches can be addressed. What is irregular and still large
// then is, with the faces round it, the cage of another stage.
#pragma once
#include "bake/surface/limit_patches.h"
#include "bake/surface/subdivision_refiner.h"

namespace bake {

inline constexpr int stage_levels = 10;            ///< of the first stage, at most
inline constexpr int further_levels = 4;           ///< of each that follows
inline constexpr int most_levels = 26;             ///< of all together
inline constexpr double smallest_irregular = 1e-6; ///< of the diagonal: smaller ones are not split further

/// All patches of a cage, with `options.isolation` levels.
void make_patches(const Mesh& cage, const SubdivisionOptions& options, LimitPatches& limit);

} // namespace bake
