// Edges of a placed shape at which its outline can lie in the picture of a camera.
#pragma once
#include "bake/verdict/plan/picture_view.h"
#include <vector>

namespace bake {

/// The edge from corner `from` of a triangle to the next one.
struct ContourEdge {
    std::uint32_t triangle = 0;
    int from = 0;
};

/// Edges of one face, of faces of which one faces the camera and another one does not, and of more than two faces. Positions
/// that are equal count as one. Edges with an end behind the camera are left out.
std::vector<ContourEdge> contour_edges(const Scene& scene, std::uint32_t instance, const PictureView& view);

} // namespace bake
