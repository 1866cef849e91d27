// What the sides of a surface that meet in a point share there: one value of the relief, one direction.
#pragma once
#include "bake/relief/displace/meetings.h"
#include "bake/relief/displace/relief_surface.h"

namespace bake {

/// One side's view of the point.
struct SideView {
    SurfacePoint point;
    ReliefValue value;
};

struct SharedValue {
    Vec3d value{0};     ///< mean of the values: of heights over uv groups, of vectors over pairs of uv and normal group
    double height = 0;  ///< mean of the heights over uv groups
    Vec3d direction{0}; ///< unit: the mean of the normals over normal groups. Where two cancel (a Moebius strip's
                        ///< closure), the first; zero where more do (round a spike)
};

/// `sides` and `views` go together.
SharedValue shared_value(const ReliefSurface& surface, const MeetingSide* sides, std::span<const SideView> views);

/// Whether side k is the first of its pair of uv and normal group.
bool first_of_groups(const MeetingSide* sides, std::size_t k) noexcept;

} // namespace bake
