// The envelope that rays start on, as a cage: a mesh with the faces of the low-poly mesh, to be edited and given back.
#pragma once
#include "bake/relief/transfer/types.h"

namespace bake {

/// The low-poly mesh with its positions pushed out, each along the direction of the rays that start there, without normals. Rays from a
/// cage end as far behind the mesh as they start before it, so that a position is as far out as the reach outward, and as half of the
/// reach inward, which is twice as far as detail was measured (measured_reach()). Distances are smoothed along the edges, and only
/// become larger. Faces without a source are pushed out by the largest reach of all.
Mesh envelope_cage(const MeshSurface& low, const TransferSources& sources);

} // namespace bake
