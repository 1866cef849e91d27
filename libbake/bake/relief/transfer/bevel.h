// A normal map that shades the hard edges of a mesh as if they were rounded, without a high-poly mesh.
#pragma once
#include "bake/relief/transfer/types.h"

namespace bake {

class Progress;

struct BevelOptions {
    double radius = 0;         ///< of the rounded edges, object units, above 0
    int width = 0, height = 0; ///< of the map in texels
    Space space = Space::tangent;
    bool directx = false; ///< green points down
    int padding = 16;     ///< texels filled beyond the charts' borders
    int tile = 0;         ///< as NormalMapOptions
};

struct BevelReport {
    std::int64_t convex = 0, concave = 0; ///< hard edges between smooth patches, with an angle
    std::int64_t kept =
        0; ///< hard edges that end within a smooth patch or are sharper than 30 degrees, and stay as they are
    std::int64_t tilted = 0; ///< texels whose normal an edge turns
    std::int64_t narrow = 0; ///< texels where a ball of the radius does not fit, and the largest one that does was used
    TransferReport texels;   ///< hit, outward, border, degenerate, padded, empty
};

struct Bevel {
    Image<float> map; ///< three channels, encoded
    BevelReport report;
};

/// Edges are hard if the normals of their two faces differ. In a mesh that is shaded smooth all over, those whose facets are more than
/// 50 degrees apart are. Only what lies beyond a hard edge turns a normal, so that smooth surfaces are not changed. The result does
/// not depend on the number of threads.
Bevel bevel(const BakeTarget& target, const BevelOptions& options, Progress* progress = nullptr);

} // namespace bake
