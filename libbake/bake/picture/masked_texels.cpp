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

Image<float> read_masked(const PictureFile& file, const MaskedTexels& texels) {
    Image<float> image(int(texels.width), int(texels.height), int(texels.masks.size()));
    std::string row(std::size_t(texels.width * texels.texel_bytes), '\0');
    const auto row_size = std::int64_t(row.size());
    for (std::int64_t y = 0; y < texels.height; ++y) {
        if (y % 256 == 0) throw_if_interrupted();
        if (file.read(texels.offset + y * texels.row_bytes, row.data(), row_size) != row_size)
            throw unreadable(file.path(), "is cut short");
        float* to = image.row(int(texels.bottom_up ? texels.height - 1 - y : y));
        for (std::int64_t at = 0; at < row_size; at += texels.texel_bytes) {
            const std::uint32_t texel = little_endian(row, std::size_t(at), std::size_t(texels.texel_bytes));
            for (const std::uint32_t mask : texels.masks) {
                const int shift = std::countr_zero(mask);
                *to++ = float(double((texel & mask) >> shift) / double(mask >> shift));
            }
        }
    }
    return image;
}

} // namespace bake
