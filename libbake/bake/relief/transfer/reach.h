// How far apart two meshes are, region by region: the envelope of a bake that needs no options.
#pragma once
#include "bake/relief/transfer/casting.h"
#include "bake/relief/transfer/high_surface.h"
#include <span>

namespace bake {

/// Per position of the low-poly mesh, from the signed distances of the high-poly mesh's corners to their nearest points of it,
/// as far as both face the same way there. A position has the extremes of all faces that it and its neighbours belong to, wider by
/// a fifth and by the skew of averaged directions; where nothing was measured, those of the whole mesh. The result does not depend
/// on the number of threads.
/// `faces`: those of the low-poly mesh that count; empty: all.
std::vector<Reach> measured_reach(const MeshSurface& low, const HighSurface& high,
                                  std::span<const std::uint8_t> faces = {});

/// The same reach everywhere.
std::vector<Reach> constant_reach(const MeshSurface& low, const Reach& reach);

} // namespace bake
