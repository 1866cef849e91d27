// The surface in pieces: stages of splitting by OpenSubdiv's Far, whose patches become leaves. Within its room only.
//
// One stage goes down ten levels at most, as deep as Far's patches can be addressed. What is irregular and still large
// then is, with the faces round it, the cage of another stage.
#pragma once
#include "bake/surface/subdivision/limit_patches.h"
#include "bake/surface/subdivision/refiner.h"

namespace bake {

inline constexpr int stage_levels = 10;            ///< of the first stage, at most
inline constexpr int further_levels = 4;           ///< of each that follows
inline constexpr int most_levels = 26;             ///< of all together, to make pieces small
inline constexpr double smallest_irregular = 1e-6; ///< of the diagonal: smaller ones are not split further
// But where the normal still turns in one so small. It does at high valences (from 10 on under Loop, 8 under
// Catmull-Clark), whose second eigenvalue is close to the first: by a factor of only .78 less per level at Loop's 10.
inline constexpr int most_turning_levels = 38;
inline constexpr double most_turn_deg = 0.01;    ///< between its facet and those beside it
inline constexpr double smallest_turning = 5e-9; ///< of the diagonal: below, it is soon rounding that turns

/// All patches of a cage, with `options.isolation` levels.
void make_patches(const Mesh& cage, const SubdivisionOptions& options, LimitPatches& limit);

} // namespace bake
