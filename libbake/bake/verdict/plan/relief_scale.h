// How long the edges of a mesh are, in texels of its height.
#pragma once
#include "bake/preview/shape.h"

namespace bake {

/// Root mean square over the triangles of the length of an edge in a picture of this size; 0 without uvs.
double edge_texels(const Shape& shape, int width, int height);

} // namespace bake
