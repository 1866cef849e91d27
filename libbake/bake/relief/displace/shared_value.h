// The one value of the relief, and the one direction, that the sides of a junction share at a point.
#pragma once
#include "bake/relief/displace/relief_surface.h"
#include "bake/surface/patch/junctions.h"

namespace bake {

/// The point as one side has it.
struct SideView {
    SurfacePoint point;
    ReliefValue value;
};

struct SharedValue {
    Vec3d value{0};    ///< mean of the values: of heights over uv groups, of vectors over pairs of uv and normal groups
    double height = 0; ///< mean of the heights over uv groups
    Vec3d direction{0}; ///< unit: the mean of the normals over normal groups. The first normal if two cancel (the
                        ///< closure of a Moebius strip); zero if more cancel (at a spike)
};

/// One view per side.
SharedValue shared_value(const ReliefSurface& surface, std::span<const JunctionSide> sides,
                         std::span<const SideView> views);

} // namespace bake
