// Structural similarity: Wang, Bovik, Sheikh and Simoncelli, "Image Quality Assessment: From Error Visibility to Structural
// Similarity", IEEE Transactions on Image Processing 13(4), 2004, equation 13.
//
//             (2 m_a m_b + C1) (2 s_ab + C2)
//   SSIM = ---------------------------------------      C1 = (0.01 peak)^2,  C2 = (0.03 peak)^2
//          (m_a^2 + m_b^2 + C1) (s_a^2 + s_b^2 + C2)
//
// m, s^2 and s_ab are means, variances and the covariance under a Gaussian window of 11 x 11 pixels with sigma 1.5, whose
// weights sum to 1. As in the authors' own program, windows that reach beyond the border are left out.
#pragma once
#include "bake/picture/image.h"

namespace bake {

/// Side of the window, and the smallest width and height of a picture.
inline constexpr int ssim_window = 11;

struct Ssim {
    /// Mean over the windows that lie in the picture; exactly 1 for equal pictures.
    double mean = 1;
    /// 1 - SSIM, from 0 to 2, one channel. It is ssim_window - 1 narrower and lower than the pictures: its pixel (x, y) is the
    /// window around pixel (x + 5, y + 5).
    Image<float> errors;
};

/// Of pictures of one channel, at least 11 x 11, whose values are finite and range from 0 to `peak`. In double, because a
/// variance is a small difference of large sums.
Ssim ssim(const Image<float>& reference, const Image<float>& test, double peak = 1);

/// Rec. 709 luma 0.2126 R + 0.7152 G + 0.0722 B of the values as they are (SSIM wants them sRGB-encoded), or the one channel
/// of a grey picture.
Image<float> luma(const Image<float>& picture);

} // namespace bake
