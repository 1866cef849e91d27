// Whether six faces join, and how they would have to stand to do so.
//
// The seam ratio is the mean step across the 12 edges of the cube over the mean step between neighbouring rows and
// columns inside the faces: about 1 or less where the faces belong together, several times that where they do not. Steps are those of the square root of
// radiance, which is near what the eye sees.
// Turning the whole cube changes no seam, so seams can tell how faces stand to each other, not which way is up.
#pragma once
#include "bake/environment/sky/cube.h"
#include <array>
#include <string>

namespace bake {

/// How the files stand in the cube: face k is file `source[k]` (0 to 5, as given), turned counter-clockwise by
/// `turns[k]` quarter turns.
struct Orientation {
    std::array<int, 6> source{0, 1, 2, 3, 4, 5};
    std::array<int, 6> turns{};
    bool as_given() const noexcept;
    bool operator==(const Orientation&) const = default;
};

struct OrientationCheck {
    double given = 0; ///< seam ratio as the files are named
    double best = 0;  ///< of the orientation below
    /// The arrangement of least squared steps among all 720 swaps with all turns of each face; of those that differ from it by a
    /// turn of the whole cube only, the one that leaves most files as they are, then px and nx.
    Orientation closes;
    double inside = 0; ///< mean step inside the faces
    /// Seams are visible as given and `closes` mends them. Judged by squared steps, which tell arrangements apart even
    /// where hardly more than noise crosses the seams, as in a sky of stars: the ratio of those is above 1.2 as given, at
    /// least 15 % less with `closes`, and then at most 1.4 or a quarter.
    bool wrong = false;
    /// Nothing to go by: every texel alike, or faces of one texel.
    bool unknown = false;
};

/// Looks at the first three channels. At most 1 second at 2048 texels.
OrientationCheck check_orientation(const Cube& cube);
/// The seam ratio alone; 0 when there is nothing to go by.
double seam_ratio(const Cube& cube);

/// Puts the faces where `orientation` says.
Cube reorient(const Cube& cube, const Orientation& orientation);

/// "+Z = bk.jpg, -Z = ft.jpg, +Y = up.jpg turned 90 deg": the faces that are not as given, with the file names;
/// counter-clockwise.
std::string to_text(const Orientation& orientation, const std::array<std::string, 6>& files);

} // namespace bake
