// Whether a triangle lies within a distance of a mesh, by laying the mesh's triangles over it.
#pragma once
#include "bake/mesh/triangle_tree.h"

namespace bake {

/// Room to work in, kept from call to call.
struct OverlayRoom {
    struct Polygon {
        int corners = 0;
        std::array<Vec3d, 12> p;
    };
    std::vector<Polygon> open, next;
    std::vector<std::uint32_t> near;
};

/// True when it could be shown that no point of the triangle p is farther from `other` than the root of limit2. It is cut
/// along the outlines of the triangles near it, seen along its normal, those in `first` before others; each part must
/// be within the limit of the one triangle over it, which is a question of its corners alone because the distance to
/// one triangle is convex. False says nothing; room.open then holds parts for which it could not be shown.
bool overlay_within(const TriangleTree& other, const std::array<Vec3d, 3>& p, const std::array<std::uint32_t, 4>& first,
                    double limit2, OverlayRoom& room);

} // namespace bake
