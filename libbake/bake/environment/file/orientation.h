// Checks whether six faces match at their seams, and finds the arrangement in which they do.
//
// The seam ratio is the mean step across the 12 edges of the cube over the mean step between neighbouring rows and columns
// inside the faces: at most about 1 if the faces match, and several times that if they do not. Steps are differences of the
// square root of radiance, which is approximately perceptual. A rotation of the whole cube changes no seam, so seams
// determine only the relative arrangement of the faces.
#pragma once
#include "bake/environment/sky/cube.h"
#include <array>
#include <string>

namespace bake {

/// An arrangement of six files: face k is file `source[k]` (0 to 5, as given), turned counter-clockwise by `turns[k]` quarter
/// turns.
struct Orientation {
    std::array<int, 6> source{0, 1, 2, 3, 4, 5};
    std::array<int, 6> turns{};
    bool as_given() const noexcept;
    bool operator==(const Orientation&) const = default;
};

struct OrientationCheck {
    double given = 0; ///< seam ratio of the files as named
    double best = 0;  ///< seam ratio of `closes`
    /// The arrangement with the smallest squared steps among all 720 permutations with all turns of each face. Among
    /// arrangements that differ only by a rotation of the whole cube, the one that keeps the most files as given, then px
    /// and nx.
    Orientation closes;
    /// Seams are visible as given, and `closes` removes them. The criterion is the seam ratio of squared steps, which
    /// distinguishes arrangements even in a sky of stars: above 1.2 as given, at least 15 % less with `closes`, and then at
    /// most 1.4 or a quarter of the given one.
    bool wrong = false;
    /// The seams tell nothing: all texels are equal, or faces have one texel.
    bool unknown = false;
};

/// Uses the first three channels. At most 1 second at 2048 texels.
OrientationCheck check_orientation(const Cube& cube);

/// Moves and turns the faces to an arrangement.
Cube reorient(const Cube& cube, const Orientation& orientation);

/// "+Z = bk.jpg, -Z = ft.jpg, +Y = up.jpg turned 90 deg": the faces that are not as given, with the file names. Turns are
/// counter-clockwise.
std::string to_text(const Orientation& orientation, const std::array<std::string, 6>& files);

} // namespace bake
