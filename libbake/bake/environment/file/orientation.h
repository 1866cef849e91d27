// Checks whether six faces match at their seams, and finds the arrangement in which they do.
//
// A rotation of the whole cube changes no seam, and neither does its mirror image: seams determine only the relative
// arrangement of the faces.
#pragma once
#include "bake/environment/file/seams.h"
#include <string>

namespace bake {

/// An arrangement of six files: face k is file `source[k]` (0 to 5, as given), first mirrored left to right if
/// `mirrored[k]`, then turned counter-clockwise by `turns[k]` quarter turns.
struct Orientation {
    std::array<int, 6> source{0, 1, 2, 3, 4, 5};
    std::array<int, 6> turns{};
    std::array<bool, 6> mirrored{};
    bool as_given() const noexcept;
    bool operator==(const Orientation&) const = default;
};

/// A seam is open if its ratio (seams.h) is above this.
inline constexpr double open_seam = 2.5;

struct OrientationCheck {
    /// Seam ratios of the faces as given, and as `closes` arranges them: the mean step across the seams over the mean step
    /// between neighbouring texels of the whole sky, at most about 1 if all faces match.
    double given = 0, best = 0;
    std::array<double, 12> given_seams{}, best_seams{}; ///< ratios, in the order of seams()
    /// The most probable arrangement: the one with the smallest sum of log(ratio^2) over the seams, ratios below 1 counted
    /// as 1, plus 0.5 for each face that is not as given and 1.5 for each that is mirrored. Among all 720 permutations of
    /// the faces with all their turns, and all turns and mirrorings of every face in its place.
    Orientation closes;
    /// `closes` is not as given, and the seams of the faces that it moves show that it is right: each of them is closed or
    /// its ratio becomes a quarter, and the mean logarithm of their ratios falls by more than 0.1 + 0.9 / sqrt(texels of an edge).
    bool wrong = false;
    /// The seams tell nothing: all texels are equal, or faces have fewer than eight texels.
    bool unknown = false;

    int open_given() const noexcept; ///< number of open seams
    int open_best() const noexcept;
    /// Whether three or more seams of one face are open as given. Fewer may be edges of things in the sky that happen to lie
    /// on a seam, but a face in a wrong place opens more.
    bool visible() const noexcept;
};

/// Uses the first three channels. At most 1 second at 2048 texels.
OrientationCheck check_orientation(const Cube& cube);

/// Moves, mirrors and turns the faces to an arrangement.
Cube reorient(const Cube& cube, const Orientation& orientation);

/// "+Z = bk.jpg, -Z = ft.jpg, +Y = up.jpg turned 90 deg": the faces that are not as given, with the file names. Turns are
/// counter-clockwise.
std::string to_text(const Orientation& orientation, const std::array<std::string, 6>& files);

} // namespace bake
