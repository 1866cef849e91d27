// Normal maps for a mesh that is displaced already.
#pragma once
#include "bake/relief/map/normal_map.h"

namespace bake {

/// The normal map, relative to `displaced`, of the height on the mesh that it displaces, `base`: what the normals of a
/// displaced, diced mesh lack, so that no slope counts twice. The normals are those of normal_map() on `base`; each is
/// written in the tangent space of the point of `displaced` with the same uv. Three channels, encoded, of tangent space
/// whatever options.space says. Texels without a normal of their own on either mesh are padded as those of normal_map().
Image<float> residual_map(const HeightField& field, const BakeTarget& base, const BakeTarget& displaced,
                          const NormalMapOptions& options, NormalMapReport& report, Progress* progress = nullptr);

} // namespace bake
