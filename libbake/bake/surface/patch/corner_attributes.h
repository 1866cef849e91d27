// Attributes of a base surface's mesh at the corners of its tessellation.
#pragma once
#include "bake/surface/patch/layout.h"

namespace bake {

/// The attributes of the base's mesh, with a value at each corner of `mesh` = tessellate(layout): interpolated between the corners
/// of the face that a patch belongs to, linearly on triangles and bilinearly on quads. Those of larger polygons that are
/// one patch to a triangle are the mean of the face. Corners of one position, normal and uv whose values agree up to
/// rounding get the same, so that they stay one vertex in files.
std::vector<Attribute> corner_attributes(const PatchLayout& layout, const Mesh& mesh);

} // namespace bake
