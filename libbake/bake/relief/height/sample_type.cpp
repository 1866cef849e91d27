#include "bake/relief/height/sample_type.h"

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
    return info.type == SampleType::i8 || info.type == SampleType::i16 || info.type == SampleType::i32;
}

double default_midlevel(const ImageInfo& info) noexcept { return is_float(info) || is_signed_integer(info) ? 0 : 0.5; }

double default_amplitude(const ImageInfo& info, double whole) noexcept { return is_float(info) ? 1 : 0.01 * whole; }

bool is_cut(const ImageInfo& info) noexcept {
    const int read = bits_as_read(info.type);
    return read > 0 && info.bits > read;
}

bool is_lossy(const ImageInfo& info) noexcept { return info.format == "jpeg" || info.format == "webp"; }

} // namespace bake
