// Pictures to be compared have finite values.
#pragma once
#include "bake/picture/image.h"
#include <string>

namespace bake {

/// Throws Error{Refusal::unsuitable} with the number of pixels that are NaN or Inf in one of the first `channels` channels, and
/// the place of the first.
void require_finite_pixels(const Image<float>& image, int channels, const std::string& file);
/// Throws Error{Refusal::unsuitable} unless the two have one size.
void require_one_size(const Image<float>& image, const std::string& file, const Image<float>& other,
                      const std::string& other_file);

} // namespace bake
