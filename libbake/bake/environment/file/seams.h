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

/// Values for side i of file a against side j of file b: table[r][4 a + i][4 b + j], r = 1 if one of the two is mirrored,
/// so that the sides run in the same direction.
using SideTable = std::array<std::array<std::array<float, 24>, 24>, 2>;

/// How every side matches every other one.
struct SideSteps {
    SideTable ratio{};   ///< step across over steps beside, root mean squares
    SideTable mean{};    ///< mean step across over the mean step between neighbouring texels of the whole sky
    bool unknown = true; ///< faces of fewer than eight texels, or all texels are equal
};

/// Compares all sides with all others; uses the first three channels. Steps beside a seam of less than 1 % of the sky's mean
/// square root of radiance, which are not visible, count as that.
SideSteps compare_sides(const Cube& cube);

} // namespace bake
