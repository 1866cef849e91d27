// Which rule for tilted shading normals comes nearest to true displacement: settings.terminator over slope and height of
// the sun, on a plane and on a sphere.
//
// The relief is an egg-box, the truth the displaced mesh that the program makes of the same height, and the rules shade the
// mesh without displacement, by the exact normal of that height. All pictures have the same samples, and squared errors
// are products of two independent halves, so that noise does not bias them.
#pragma once
#include "bake/preview/terminator.h"
#include <array>
#include <string>
#include <vector>

namespace bake::test {

inline constexpr std::array<Terminator, 5> all_terminators = {Terminator::off, Terminator::flip, Terminator::rotate,
                                                              Terminator::estevez, Terminator::chiang};
inline constexpr std::array<const char*, 5> terminator_names = {"off", "flip", "rotate", "estevez", "chiang"};

struct TerminatorMapOptions {
    std::vector<double> slopes = {0.125, 0.25, 0.5, 1, 2, 4};      ///< the steepest of the relief
    std::vector<double> heights_deg = {5, 10, 20, 30, 45, 60, 80}; ///< of the sun; for a mirror of the viewer
    std::vector<std::string> cases = {"plane 30 lambert",  "plane 60 lambert", "sphere lambert", "plane 30 phong 50",
                                      "plane 60 phong 50", "sphere phong 50",  "plane mirror"};
    int edge = 64, spp = 16; ///< of the pictures
    int azimuths = 4;        ///< of the sun around a plane
    int segments = 256;      ///< of the truth along an edge of the plane, and around the sphere twice as many
};

/// RMSE against the displaced mesh, over the pixels that show one of the two.
struct TerminatorRow {
    std::string name; ///< of the case: "plane 30" is seen 30 degrees from its normal
    double slope = 0, height_deg = 0;
    double truth = 0;             ///< root mean square of the displaced picture there
    std::array<double, 5> rmse{}; ///< in the order of all_terminators
    /// The rule with the least error; `off` where that is less than 1 % better than `off`.
    int best() const noexcept;
};

std::vector<TerminatorRow> terminator_map(const TerminatorMapOptions& options = {});

} // namespace bake::test
