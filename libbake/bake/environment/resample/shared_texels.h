// Texels that an edge-sampled environment holds more than once: on the edges and corners of the faces, and in the outer
// columns and rows of a lat-long.
#pragma once
#include "bake/environment/sky/cube.h"
#include <array>
#include <vector>

namespace bake {

/// Values of the border texels of a face, channels() each, by border_index.
using Border = std::vector<float>;

/// A border texel belongs to two or three faces; each of them gets the mean over the texel's whole solid angle. `sums`:
/// FaceAccumulator::border of the faces.
std::array<Border, 6> join_borders(int n, int channels, const std::array<std::vector<double>, 6>& sums);

/// An edge-sampled border texel covers area on two faces, so its centroid is |t| / 8 texel farther from the edge midpoint
/// than its sample point, t in [-1, 1]. Shifts the values back by linear interpolation with the neighbour on that side.
/// Flux changes only by the variation of |t| / 8 from texel to texel.
void shift_to_samples(int n, int channels, Border& border);

/// Writes the border texels of rows [low, high) of a face.
void put_border(const Border& border, int n, int channels, int low, int high, float* values);

/// Whether the shared texels of an edge-sampled lat-long are equal.
bool is_joined(const Image<float>& latlong) noexcept;
/// An edge-sampled lat-long with the mean of each set of shared texels.
Image<float> joined(const Image<float>& latlong);

} // namespace bake
