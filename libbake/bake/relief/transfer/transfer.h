// The detail of high-poly meshes on the uvs of a low-poly mesh: a normal map, and the height of the detail.
//
// A ray starts on an envelope around the low-poly mesh and goes inward. It lands where it first meets the front of a high-poly
// triangle, so that a bolt that floats above a surface is seen before the surface. The normal there, in the tangent space of the
// point of the low-poly mesh that the ray goes through, is the texel.
#pragma once
#include "bake/relief/transfer/types.h"

namespace bake {

class Progress;

/// A texel that is missed has the value of the nearest one that is not, if that is at most `padding` texels away, else the flat
/// normal. The average of several rays is over the part of the texel that lies in
/// charts, by Gauss and Legendre's rule in each direction: an average over a smooth surface is exact to the degree 2 rays - 1.
/// `target` has the size and the tile of the options. The result does not depend on the number of threads.
Transfer transfer(const BakeTarget& target, const TransferSources& sources, const TransferOptions& options,
                  const std::string& path, Progress* progress = nullptr);
/// From one source.
Transfer transfer(const BakeTarget& target, const HighSurface& high, const Casting& casting,
                  const TransferOptions& options, const std::string& path, Progress* progress = nullptr);

} // namespace bake
