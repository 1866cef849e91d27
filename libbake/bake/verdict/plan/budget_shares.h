// How the budget of the frame is shared among its objects.
//
// The frame may have a mean squared error of B^2 over the pixels of all objects together. An object that needs little of that
// leaves the rest to one whose model would cost much to improve. No object takes more than twice its part.
#pragma once
#include <span>
#include <vector>

namespace bake {

/// What an object could be shown as.
struct ShareOption {
    double cost = 0;
    double square = 0; ///< upper bound of the mean squared error over its pixels
};
struct SharingObject {
    std::vector<double> area;         ///< pixels, of each camera
    std::vector<ShareOption> options; ///< dearest first: the one within the budget alone, then cheaper ones
};

inline constexpr double most_share = 2; ///< of B^2, of one object

/// The index of the option that each object takes: of all steps to a cheaper option, the one that saves most cost per error
/// that it adds comes first, as long as the frame keeps its budget in the picture of every camera.
std::vector<int> share_budget(std::span<const SharingObject> objects, double budget);

} // namespace bake
