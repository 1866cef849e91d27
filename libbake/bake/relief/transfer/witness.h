// Texels by which a bake can be judged: where rays found nothing, or went farthest.
#pragma once
#include "bake/relief/transfer/types.h"

namespace bake {

struct Witness {
    int x = 0, y = 0;       ///< texel, row 0 at the top
    std::uint32_t face = 0; ///< of the low-poly mesh
    Vec2d uv{0};
    Cast cast;
    TexelState state = TexelState::missed;
    double height = 0; ///< of the detail over the low-poly mesh; of a miss 0
    /// Of a miss: the corner of the high-poly meshes that is nearest to the low-poly mesh there, and its distance.
    Vec3f nearest{0};
    double distance = 0;
    std::string mesh; ///< that has the corner
};

/// The first `most` misses in the order of texels.
std::vector<Witness> missed_texels(const BakeTarget& target, const TransferSources& sources, const Transfer& result,
                                   std::size_t most);
/// Up to `most` texels with detail far from the low-poly mesh, the farthest first; no two of the same four rows.
std::vector<Witness> farthest_texels(const BakeTarget& target, const TransferSources& sources, const Transfer& result,
                                     std::size_t most);

} // namespace bake
