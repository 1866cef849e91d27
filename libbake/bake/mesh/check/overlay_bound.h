// Whether a triangle is within a distance of a mesh, by clipping it against the triangles of the mesh.
#pragma once
#include "bake/mesh/triangle_tree.h"

namespace bake {

/// Buffers that are reused from call to call.
struct OverlayBuffers {
    struct Polygon {
        int corners = 0;
        std::array<Vec3d, 12> p;
    };
    std::vector<Polygon> open, next;
    std::vector<std::uint32_t> near;
};

/// True if no point of the triangle p is farther from `other` than the square root of limit2. The triangle p is cut along
/// the outlines of nearby triangles, which are projected along its normal, those in `first` before the others. Each part
/// must be within the limit of the triangle that covers it; testing the corners of the part is sufficient, because the
/// distance to one triangle is convex. False means that the test was inconclusive; buffers.open then contains the parts
/// for which it failed.
bool overlay_within(const TriangleTree& other, const std::array<Vec3d, 3>& p, const std::array<std::uint32_t, 4>& first,
                    double limit2, OverlayBuffers& buffers);

} // namespace bake
