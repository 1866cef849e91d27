// Distinct values of an image and the bit depth that represents them.
#pragma once
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"

namespace bake {

/// Distinct values are counted up to this number, that of 16 bits.
inline constexpr int most_levels = 65536;

/// One channel or, if count > 1, the mean of `count` channels from `channel` on.
struct Plane {
    const Image<float>* image;
    int channel = 0, count = 1;
};

/// Calls visit(value) for every finite value until it returns false.
template <class Visit> void for_values(const Plane& plane, const Visit& visit) {
    for (int y = 0; y < plane.image->height(); ++y) {
        const float* v = plane.image->row(y) + plane.channel;
        for (int x = 0; x < plane.image->width(); ++x, v += plane.image->channels()) {
            float value = v[0];
            if (plane.count > 1) {
                for (int c = 1; c < plane.count; ++c) value += v[c];
                value /= float(plane.count);
            }
            if (value - value == 0 && !visit(value)) return;
        }
    }
}

struct Levels {
    int count = 0;         ///< number of distinct values; most_levels + 1 if there are more than most_levels
    int true_bits = 0;     ///< smallest bit depth that represents all values; 0: floats that need more than 16 bits
    double least_step = 0; ///< smallest difference of two values; 0 if there are fewer than two or too many values
};
/// `has_finite`: whether any value is finite. true_bits is computed for single channels only.
Levels count_levels(const Plane& plane, const ImageInfo& info, bool has_finite);

} // namespace bake
