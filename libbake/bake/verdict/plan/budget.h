// How far the picture of a planned scene may be from the picture of the reference.
//
// The error is the RMSE of exposed linear light over the area that an object covers. Every sample is exposed and clamped to
// [0, 1] before samples are averaged, and the three channels count alike. Without the clamp the error has no bound: a mirror
// and a small sun can hide any error between two samples.
#pragma once
#include <string>

namespace bake {

struct Budget {
    enum class Metric { rmse, flip, degrees };
    Metric metric = Metric::rmse;
    double value = 0.01;         ///< degrees: mean angle between shading normals
    std::string name = "normal"; ///< as the user wrote it
};

/// "strict" (rmse .005), "normal" (.01), "loose" (.02), "rmse=.01", "flip=.02", "deg=1"; values are finite and not
/// negative, or "inf". Throws Error{Refusal::usage} for anything else.
Budget parse_budget(const std::string& word);

} // namespace bake
