// How many texels a chart has, and how much of the detail they can hold.
#pragma once
#include "bake/relief/transfer/types.h"

namespace bake {

struct Percentiles {
    double p05 = 0, median = 0, p95 = 0, max = 0;
};

/// Texels per object unit over the surface of the low-poly mesh: the root of the number of texels per area of its triangles. All
/// zero for a mesh without area in uv.
Percentiles texel_density(const BakeTarget& target, int width, int height);

/// Angle in degrees between the normal at the centre of a texel, which one ray finds, and the mean over the texel, which a
/// distant viewer sees, from the curvature of the map: (n(x - 1) - 2 n(x) + n(x + 1)) / 24, and the same along y. Of texels with
/// four neighbours that found detail; of maps of more than four million texels in some rows.
Percentiles centre_error(const Transfer& result, Space space, bool directx);

/// A picture of what the texels found, three channels from 0 to 1: near black outside of the charts, red where rays find nothing,
/// orange where they find nothing but backs, blue where the part has no counterpart, magenta where the normal points into the
/// low-poly mesh; elsewhere grey by the angle of centre_error(), white from one degree on.
Image<float> report_map(const Transfer& result, Space space, bool directx);

} // namespace bake
