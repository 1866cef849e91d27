// The envelope of a bake and some of its rays as a mesh, to be looked at in any viewer.
#pragma once
#include "bake/relief/transfer/witness.h"
#include <span>

namespace bake {

/// Faces of three materials: "cage", a thin rod for each edge of the low-poly mesh where rays start; "rays", one needle
/// for each of up to `most` texels evenly spread over those that found something, from the cage to where it landed or
/// ends; "misses", the witnesses that are misses.
Mesh debug_rays(const BakeTarget& target, const TransferSources& sources, const Transfer& result,
                std::span<const Witness> witnesses, int most = 2000);

} // namespace bake
