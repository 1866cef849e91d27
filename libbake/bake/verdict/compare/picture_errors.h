// How far the picture of a method is from the reference, with the standard errors that the samples leave.
//
// Pictures come as two independent halves of the samples, a and b; test and reference use the same random numbers, so that
// most of the noise cancels. With d the difference of a pixel, a vector of three channels, its squared error is estimated by
//   m = d_a . d_b / 3
// which noise does not bias, as it does the square of a single difference. The variance of m is estimated by
//   (|d_a|^2 - |d_b|^2)^2 / (2 * 3)^2
// which is unbiased for noise that is Gaussian: with s = d_a + d_b and e = d_a - d_b independent of each other,
// E[(s . e)^2] = 4 var(d_a . d_b). Pixels have independent noise, so that the variances of pixels add up.
//
// SSIM and FLIP are not sums of squares, and noise adds to their values. They are computed of the mean pictures; their
// standard errors are half the differences between those of the two halves, added up over tiles of 32 x 32 pixels as if tiles
// were independent.
#pragma once
#include "bake/preview/render.h"
#include "bake/verdict/compare/silhouette.h"
#include "bake/verdict/metric/error_summary.h"
#include "bake/verdict/metric/hdr_flip.h"

namespace bake {

struct Estimate {
    double value = 0, error = 0; ///< error: one standard error
};

/// What a method shows.
struct MethodPicture {
    Halves halves;        ///< linear light
    Image<float> normals; ///< mean shading normals
    ObjectMask mask;
};

/// Mean of both halves.
Image<float> mean_picture(const Halves& halves);

/// Errors over a set of pixels.
struct AreaErrors {
    Estimate square; ///< mean squared error of exposed linear light, clamped to [0, 1]; noise may make it negative
    Estimate rmse;   ///< its root; 0 where the square is not above 0
    Estimate psnr;   ///< dB, of what is shown; infinite for equal pictures
    Estimate ssim;   ///< mean over the windows around the pixels
    Estimate flip;
    ErrorSummary flip_of_pixels, hdr_flip_of_pixels;
    Estimate hdr_flip;
    std::int64_t pixels = 0;
};

struct PictureErrorOptions {
    float exposure = 0; ///< stops
    FlipOptions flip;
};

struct PictureErrors {
    AreaErrors object, frame; ///< of the pixels that show the object in either picture; of all pixels
    ErrorSummary angles;      ///< degrees between mean shading normals of pixels that show the object in both pictures
    OutlineError outline;
    Image<float> flip; ///< one channel
    PixelRect worst;   ///< the part of the picture with the largest FLIP error
};

/// Mean squared error over the pixels of the mask, by halves.
Estimate square_error(const Halves& reference, const Halves& test, float exposure,
                      const std::vector<std::uint8_t>& pixels);
Estimate root(const Estimate& square) noexcept;

/// The pictures have one size, at least 11 x 11 for SSIM (else it is 1).
PictureErrors picture_errors(const MethodPicture& reference, const MethodPicture& test,
                             const PictureErrorOptions& options);

/// Of all pixels of a picture.
struct FrameErrors {
    Estimate rmse;             ///< of exposed linear light, clamped to [0, 1]
    Image<float> flip;         ///< one channel
    ErrorSummary flip_summary; ///< of `flip`
    PixelRect worst;           ///< the part of the picture with the largest FLIP error
};
FrameErrors frame_errors(const Halves& reference, const Halves& test, const PictureErrorOptions& options);

} // namespace bake
