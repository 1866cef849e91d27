#include "bake/picture/masked_texels.h"
#include "bake/base/progress.h"
#include <algorithm>
#include <bit>

namespace bake {

std::uint32_t little_endian(const std::string& head, std::size_t at, std::size_t bytes) noexcept {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes && at + bytes <= head.size(); ++i)
        value |= std::uint32_t(static_cast<unsigned char>(head[at + i])) << 8 * i;
    return value;
}

void describe_masked(const PictureFile& file, const MaskedTexels& texels, const ReadLimits& limits, ImageInfo& info) {
    const std::int64_t width = texels.width, height = texels.height;
    if (width > (1 << 24) || height > (1 << 24)) throw unreadable(file.path(), "claims more texels than it can hold");
    for (const std::uint32_t mask : texels.masks) {
        const std::uint64_t bits = mask >> (mask ? std::countr_zero(mask) : 0);
        if (mask == 0 || (bits & (bits + 1)) != 0)
            throw unreadable(file.path(), "has a channel whose mask is empty or has gaps");
    }
    const Window window{0, 0, int(width), int(height)};
    check_size(file.path(), file.size(), {window, window, int(texels.masks.size())}, limits);
    info.width = int(width), info.height = int(height);
    info.bits = 0;
    for (std::size_t c = 0; c < texels.masks.size(); ++c)
        if (int(c) != info.alpha_channel) info.bits = std::max(info.bits, std::popcount(texels.masks[c]));
    info.type = info.bits <= 8 ? SampleType::u8 : info.bits <= 16 ? SampleType::u16 : SampleType::u32;
    if (texels.offset + (height - 1) * texels.row_bytes + width * texels.texel_bytes > file.size())
        throw unreadable(file.path(), "is cut short");
}

namespace {

/// A channel of a texel as a float. Channels of few bits are looked up.
class Channel {
public:
    explicit Channel(std::uint32_t mask) : mask_(mask), shift_(std::countr_zero(mask)) {
        const std::uint32_t largest = mask >> shift_;
        if (largest > 0xffff) return;
        values_.resize(std::size_t(largest) + 1);
        for (std::uint32_t v = 0; v <= largest; ++v) values_[v] = float(double(v) / largest);
    }
    float operator()(std::uint32_t texel) const noexcept {
        const std::uint32_t value = (texel & mask_) >> shift_;
        return values_.empty() ? float(double(value) / double(mask_ >> shift_)) : values_[value];
    }

private:
    std::uint32_t mask_;
    int shift_;
    std::vector<float> values_;
};

} // namespace

void read_masked(const PictureFile& file, const MaskedTexels& texels, float* to) {
    std::vector<Channel> channels;
    for (const std::uint32_t mask : texels.masks) channels.emplace_back(mask);
    std::string row(std::size_t(texels.width * texels.texel_bytes), '\0');
    const auto row_size = std::int64_t(row.size()), row_floats = texels.width * std::int64_t(channels.size());
    for (std::int64_t y = 0; y < texels.height; ++y) {
        if (y % 256 == 0) throw_if_interrupted();
        if (file.read(texels.offset + y * texels.row_bytes, row.data(), row_size) != row_size)
            throw unreadable(file.path(), "is cut short");
        float* at = to + row_floats * (texels.bottom_up ? texels.height - 1 - y : y);
        for (std::int64_t byte = 0; byte < row_size; byte += texels.texel_bytes) {
            std::uint32_t texel = 0;
            for (std::int64_t i = 0; i < texels.texel_bytes; ++i)
                texel |= std::uint32_t(static_cast<unsigned char>(row[std::size_t(byte + i)])) << 8 * i;
            for (const Channel& channel : channels) *at++ = channel(texel);
        }
    }
}

} // namespace bake
