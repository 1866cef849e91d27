// Where a picture shows an object, and how far the outlines of two such pictures are apart.
#pragma once
#include "bake/preview/scene.h"
#include <cstdint>
#include <vector>

namespace bake {

/// Whether the object is what a ray from the camera hits first: `factor` x `factor` rays per pixel, through the middles of as
/// many squares, whatever the samples of the picture are.
struct ObjectMask {
    int factor = 1, width = 0, height = 0; ///< size in rays: that of the picture times `factor`
    std::vector<std::uint8_t> inside;      ///< row by row; 1 or 0
    bool at(int x, int y) const noexcept { return inside[std::size_t(y) * std::size_t(width) + std::size_t(x)] != 0; }
};

/// `of_object` has one entry per instance of the built scene.
ObjectMask object_mask(const Scene& scene, const std::vector<std::uint8_t>& of_object, int factor);

/// Pixels of which a ray of either mask hits the object. The masks have one size.
std::vector<std::uint8_t> pixels_of_either(const ObjectMask& a, const ObjectMask& b);

/// Distances in pixels between two outlines: of each point of either one to the nearest point of the other.
struct OutlineError {
    double mean = 0, max = 0;
    bool known = true; ///< false: one of the pictures shows no outline, and the other one does
};

/// The outline consists of the rays inside a mask that have a neighbour above, below, to the left or to the right outside it.
/// The border of the picture is no outline. Exactly 0 for equal masks; else right to 1 / factor of a pixel.
OutlineError outline_error(const ObjectMask& a, const ObjectMask& b);

} // namespace bake
