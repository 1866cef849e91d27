// The twelve seams of six faces, and how well the sides of two faces match.
//
// Every seam is judged by itself: the mean squared step across it is divided by that between the rows next to it inside
// its two faces. The ratio is about 1 for faces that match, however rough or smooth the sky is there. Steps are
// differences of the square root of radiance, which is approximately perceptual: in linear radiance a few lamps would
// outweigh everything else.
#pragma once
#include "bake/environment/sky/cube.h"
#include <array>

namespace bake {

/// A side of a face: 0 top, 1 right, 2 bottom, 3 left; each runs clockwise around the face.
struct FaceSide {
    int face, side;
};
/// An edge of the cube as two sides, which run in opposite directions as seen from inside.
struct Seam {
    FaceSide a, b;
};
const std::array<Seam, 12>& seams();

/// Step across over steps beside, as root mean squares, of side i of file a against side j of file b:
/// ratio[r][4 a + i][4 b + j], r = 1 if one of the two is mirrored, so that the sides run in the same direction.
struct SideRatios {
    std::array<std::array<std::array<float, 24>, 24>, 2> ratio{};
    bool unknown = true; ///< faces of fewer than 4 texels, or all texels are equal
};

/// Compares all sides with all others; uses the first three channels. Steps below 1 % of the sky's mean square root of
/// radiance, which are not visible, count as that.
SideRatios compare_sides(const Cube& cube);

/// Mean step across the seams over the mean step between neighbouring texels inside the faces: at most about 1 if all faces
/// match. 0 if all texels are equal.
double mean_seam_ratio(const Cube& cube);

} // namespace bake
