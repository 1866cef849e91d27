#include "bake/relief/height/sample_type.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Bits of a sample as read_image() receives it; 0: any.
int bits_as_read(SampleType type) noexcept { return type == SampleType::u8 ? 8 : type == SampleType::u16 ? 16 : 0; }

} // namespace

bool is_float(const ImageInfo& info) noexcept {
    return info.type == SampleType::half || info.type == SampleType::float32 ||
           (info.type == SampleType::other && info.bits > 32);
}

bool is_signed_integer(const ImageInfo& info) noexcept {
    return info.type == SampleType::other && info.bits >= 2 && info.bits <= 32;
}

double level_step(const ImageInfo& info) noexcept {
    if (is_float(info) || info.bits < 1) return 0;
    if (is_signed_integer(info)) return 1 / (std::exp2(info.bits - 1) - 1);
    const int read = bits_as_read(info.type);
    return 1 / (std::exp2(read > 0 ? std::min(read, info.bits) : info.bits) - 1);
}

double default_midlevel(const ImageInfo& info) noexcept { return is_float(info) || is_signed_integer(info) ? 0 : 0.5; }

bool is_cut(const ImageInfo& info) noexcept {
    const int read = bits_as_read(info.type);
    return read > 0 && info.bits > read;
}

bool is_lossy(const ImageInfo& info) noexcept {
    return info.format == "jpeg" || info.format == "webp" || info.format == "heif";
}

} // namespace bake
