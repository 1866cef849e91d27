// FLIP: how much a viewer sees who flips between two pictures in place.
// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild, "FLIP: A Difference Evaluator for Alternating Images",
// Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2) (HPG 2020).
//
//   colour     both pictures are filtered with the contrast sensitivity of the eye (section 4.1.1), then compared in a
//              perceptually uniform space (4.1.2), and the distance is mapped to [0, 1] (4.1.3)
//   features   edges and points of the luminance (4.2), compared by their strength
//   error      colour ^ (1 - features)
#pragma once
#include "bake/picture/image.h"

namespace bake {

/// Pixels per degree of a viewer 0.7 m in front of a screen 0.7 m wide with 3840 pixels, the paper's default.
inline constexpr double flip_pixels_per_degree = 67.02064327658226;

struct FlipOptions {
    double pixels_per_degree = flip_pixels_per_degree; ///< from 1 to 1000
};

/// Errors in [0, 1], one channel; exactly 0 for equal pictures. The pictures have one size and three channels, linear RGB,
/// clamped here to [0, 1]; values are finite. Borders are repeated. In float: rounding of about 1e-5 in Lab becomes at most
/// 2e-5 of FLIP, where the difference itself is that small, and far less elsewhere.
Image<float> flip(const Image<float>& reference, const Image<float>& test, const FlipOptions& options = {});

} // namespace bake
