// Smooth normals for high-poly meshes made of stairs, as voxels give them.
//
// The normal at x is the sum of the area vectors of all facets near x, weighted by a Gaussian of their distance. By the divergence
// theorem this is the gradient, turned outward, of the body's indicator function after it was blurred by the same Gaussian. So it does
// not matter how the stairs go, but only which places are inside.
#pragma once
#include "bake/mesh/mesh.h"

namespace bake {

/// Gives all corners at a position one normal. `length`: standard deviation of the Gaussian, above 0, object units. Facets of other
/// connected pieces of the mesh do not count; faces that share a position are connected. Where the sum is zero, corners have no normal,
/// and get one from their facets (corner_normals()). The result does not depend on the number of threads.
void smooth_normals(Mesh& mesh, double length);

} // namespace bake
