// Adobe, "TIFF Revision 6.0".
#include "bake/picture/tiff_samples.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <half.h>
#include <limits>
#include <tiffio.h>

namespace bake {
namespace {

template <class Stored> Stored load(const unsigned char* from, bool swapped) noexcept {
    unsigned char bytes[sizeof(Stored)];
    std::memcpy(bytes, from, sizeof bytes);
    if (swapped) std::reverse(bytes, bytes + sizeof bytes);
    Stored value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

template <class Level> void levels(const unsigned char* from, float* to, std::int64_t count, bool swapped) noexcept {
    constexpr auto largest = std::numeric_limits<Level>::max();
    // A 32-bit level has more digits than a float: rounded once.
    using Wide = std::conditional_t<sizeof(Level) == 4, double, float>;
    constexpr Wide step = Wide(1) / Wide(largest);
    if (!swapped)
        for (std::int64_t i = 0; i < count; ++i) {
            Level level;
            std::memcpy(&level, from + i * std::int64_t(sizeof level), sizeof level);
            to[i] = float(Wide(level) * step);
        }
    else
        for (std::int64_t i = 0; i < count; ++i)
            to[i] = float(Wide(load<Level>(from + i * std::int64_t(sizeof(Level)), true)) * step);
}

template <class Float> void floats(const unsigned char* from, float* to, std::int64_t count, bool swapped) noexcept {
    for (std::int64_t i = 0; i < count; ++i)
        to[i] = float(load<Float>(from + i * std::int64_t(sizeof(Float)), swapped));
}

void halves(const unsigned char* from, float* to, std::int64_t count, bool swapped) noexcept {
    for (std::int64_t i = 0; i < count; ++i) {
        Imath::half half;
        half.setBits(load<std::uint16_t>(from + 2 * i, swapped));
        to[i] = half;
    }
}

/// Samples of any number of bits, packed from the highest bit of the first byte on.
void packed(const TiffSamples& samples, const unsigned char* from, float* to, std::int64_t count) noexcept {
    const int bits = samples.bits;
    const bool with_sign = samples.format == SAMPLEFORMAT_INT;
    const double step = 1 / (std::ldexp(1.0, bits - with_sign) - 1);
    std::uint64_t window = 0;
    int filled = 0;
    for (std::int64_t i = 0; i < count; ++i) {
        for (; filled < bits; filled += 8) window = window << 8 | *from++;
        const std::uint64_t level = window >> (filled -= bits) & ((std::uint64_t(1) << bits) - 1);
        const bool negative = with_sign && level >> (bits - 1);
        to[i] = float((double(level) - (negative ? std::ldexp(1.0, bits) : 0)) * step);
    }
}

/// Samples of three bytes in this machine's order, as libtiff gives them.
void triples(const TiffSamples& samples, const unsigned char* from, float* to, std::int64_t count) noexcept {
    constexpr bool little = std::endian::native == std::endian::little;
    const bool with_sign = samples.format == SAMPLEFORMAT_INT;
    const double step = 1 / (std::ldexp(1.0, 24 - with_sign) - 1);
    for (std::int64_t i = 0; i < count; ++i, from += 3) {
        const int level = from[little ? 2 : 0] << 16 | from[1] << 8 | from[little ? 0 : 2];
        to[i] = float((with_sign && level >> 23 ? level - (1 << 24) : level) * step);
    }
}

void indices(const TiffSamples& samples, const unsigned char* from, float* to, std::int64_t count, bool swapped) {
    to_floats({.bits = samples.bits}, from, to, count, swapped);
    const float largest = std::ldexp(1.0f, samples.bits) - 1;
    for (std::int64_t i = 0; i < count; ++i) to[i] = std::round(to[i] * largest);
}

int stored_colours(const TiffSamples& samples) noexcept {
    switch (samples.photometric) {
    case PHOTOMETRIC_SEPARATED: return std::min(4, samples.per_texel);
    case PHOTOMETRIC_RGB:
    case PHOTOMETRIC_YCBCR:
    case PHOTOMETRIC_LOGLUV: return std::min(3, samples.per_texel);
    default: return 1;
    }
}

} // namespace

bool is_known(const TiffSamples& samples) noexcept {
    const int bits = samples.bits;
    switch (samples.format) {
    case SAMPLEFORMAT_UINT:
    case SAMPLEFORMAT_VOID: return bits >= 1 && bits <= 32;
    case SAMPLEFORMAT_INT: return bits >= 2 && bits <= 32;
    case SAMPLEFORMAT_IEEEFP: return bits == 16 || bits == 32 || bits == 64;
    default: return false;
    }
}

SampleType sample_type(const TiffSamples& samples) noexcept {
    const int bits = samples.bits;
    if (samples.format == SAMPLEFORMAT_IEEEFP) return bits == 16 ? SampleType::half : SampleType::float32;
    if (samples.format == SAMPLEFORMAT_INT)
        return bits <= 8 ? SampleType::i8 : bits <= 16 ? SampleType::i16 : SampleType::i32;
    return bits <= 8 ? SampleType::u8 : bits <= 16 ? SampleType::u16 : SampleType::u32;
}

int channel_count(const TiffSamples& samples) noexcept {
    const int stored = stored_colours(samples), extra = samples.per_texel - stored;
    return (samples.photometric == PHOTOMETRIC_PALETTE || stored == 4 ? 3 : stored) + extra;
}

void to_floats(const TiffSamples& samples, const unsigned char* from, float* to, std::int64_t count, bool swapped) {
    if (!samples.palette.empty()) return indices(samples, from, to, count, swapped);
    if (samples.format == SAMPLEFORMAT_IEEEFP)
        return samples.bits == 16   ? halves(from, to, count, swapped)
               : samples.bits == 32 ? floats<float>(from, to, count, swapped)
                                    : floats<double>(from, to, count, swapped);
    const bool with_sign = samples.format == SAMPLEFORMAT_INT;
    switch (samples.bits) {
    case 8:
        return with_sign ? levels<std::int8_t>(from, to, count, false) : levels<std::uint8_t>(from, to, count, false);
    case 16:
        return with_sign ? levels<std::int16_t>(from, to, count, swapped)
                         : levels<std::uint16_t>(from, to, count, swapped);
    case 24: return triples(samples, from, to, count);
    case 32:
        return with_sign ? levels<std::int32_t>(from, to, count, swapped)
                         : levels<std::uint32_t>(from, to, count, swapped);
    default: packed(samples, from, to, count);
    }
}

bool are_channels(const TiffSamples& samples) noexcept {
    return samples.palette.empty() && samples.photometric != PHOTOMETRIC_MINISWHITE &&
           samples.photometric != PHOTOMETRIC_SEPARATED && samples.photometric != PHOTOMETRIC_LOGLUV;
}

void to_channels(const TiffSamples& samples, const float* from, float* to, std::int64_t count) noexcept {
    const int stored = stored_colours(samples), extra = samples.per_texel - stored;
    const auto entries = std::int64_t(samples.palette.size() / 3);
    for (std::int64_t i = 0; i < count; ++i, from += extra, to += extra) {
        if (entries > 0) {
            const auto index = std::clamp<std::int64_t>(std::int64_t(*from), 0, entries - 1);
            to = std::copy_n(samples.palette.data() + 3 * index, 3, to);
        } else if (samples.photometric == PHOTOMETRIC_MINISWHITE) {
            *to++ = samples.format == SAMPLEFORMAT_INT ? -*from : 1 - *from;
        } else if (samples.photometric == PHOTOMETRIC_SEPARATED && stored == 4) {
            for (int c = 0; c < 3; ++c) *to++ = (1 - from[c]) * (1 - from[3]);
        } else if (samples.photometric == PHOTOMETRIC_LOGLUV && stored == 3) {
            // libtiff's own way from XYZ to the primaries of sRGB.
            const float x = from[0], y = from[1], z = from[2];
            *to++ = 2.690f * x - 1.276f * y - 0.414f * z;
            *to++ = -1.022f * x + 1.978f * y + 0.044f * z;
            *to++ = 0.061f * x - 0.224f * y + 1.163f * z;
        } else {
            to = std::copy_n(from, stored, to);
        }
        from += stored;
        std::copy_n(from, extra, to);
    }
}

} // namespace bake
