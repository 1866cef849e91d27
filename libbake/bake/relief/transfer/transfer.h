// The detail of high-poly meshes on the uvs of a low-poly mesh: a normal map, and the height of the detail.
//
// A ray starts on an envelope around the low-poly mesh and goes inward. It lands where it first meets the front of a high-poly
// triangle, so that a bolt that floats above a surface is seen before the surface. The normal there, in the tangent space of the
// point of the low-poly mesh that the ray goes through, is the texel.
#pragma once
#include "bake/base/progress.h"
#include "bake/relief/transfer/types.h"
#include <atomic>

namespace bake {

/// How far a bake is; may be read from any thread while it runs.
struct TransferProgress {
    std::atomic<int> passes{1};        ///< over the map
    std::atomic<std::int64_t> rows{0}; ///< of the map, in all passes
    std::atomic<std::int64_t> rays{0};
    Progress watched; ///< tells Job::watch of the rows
};

/// A texel that finds nothing is filled like those outside of the charts: in the first ring around texels with detail by linear
/// continuation, up to `padding` texels away by the nearest one, else with the flat normal. Several rays are averaged over the part
/// of the texel that lies in charts. They are the points of Gauss and Legendre's rule along both sides, so that the mean of a
/// polynomial of degree 2 * rays - 1 along each side is exact; under max_error_deg many texels have fewer. `target` has the size and
/// the tile of the options. The result does not depend on the number of threads.
Transfer transfer(const BakeTarget& target, const TransferSources& sources, const TransferOptions& options,
                  const std::string& path, TransferProgress* progress = nullptr);
/// From one source.
Transfer transfer(const BakeTarget& target, const HighSurface& high, const Casting& casting,
                  const TransferOptions& options, const std::string& path, TransferProgress* progress = nullptr);

} // namespace bake
