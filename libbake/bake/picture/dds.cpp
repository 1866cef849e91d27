#include "bake/picture/dds.h"
#include "bake/base/progress.h"
#include "bake/picture/dds_header.h"
#include "bake/picture/masked_texels.h"
#include <algorithm>
#include <bit>
#include <cstring>
#include <half.h>

namespace bake {
namespace {

MaskedTexels masked_texels(const DdsHeader& header) {
    return {.width = header.width,
            .height = header.height,
            .offset = header.offset,
            .row_bytes = header.width * header.texel_bytes,
            .texel_bytes = header.texel_bytes,
            .masks = header.masks};
}

int bits_of(SampleType type) noexcept { return type == SampleType::float32 ? 32 : 16; }

void describe(const PictureFile& file, const DdsHeader& header, const ReadLimits& limits, ImageInfo& info) {
    info.format = "dds";
    info.channels = header.channels;
    info.alpha_channel = header.alpha_channel;
    const auto before_alpha = int(header.channels.size()) - (header.alpha_channel >= 0 ? 1 : 0);
    info.colours = before_alpha == 1 || before_alpha == 3 ? before_alpha : 0;
    const Window window{0, 0, int(header.width), int(header.height * header.faces)};
    check_size(file.path(), file.size(), {window, window, int(header.channels.size())}, limits);
    info.type = header.type, info.bits = bits_of(header.type);
    if (!header.masks.empty()) describe_masked(file, masked_texels(header), limits, info);
    info.width = window.width, info.height = window.height;
    if (header.faces == 6) info.environment = EnvironmentTag::cube;
    if (header.srgb) info.srgb_tagged = true, info.colour = {.source = "DXGI format", .curves = {srgb_curve()}};
    if (header.arrays > 1)
        info.notes.push_back("has an array of " + std::to_string(header.arrays) +
                             " pictures: the first is read, the others are left out");
}

float sample_at(const char* at, SampleType type) noexcept {
    std::uint32_t bits = 0;
    for (int i = 0; i < bits_of(type) / 8; ++i) bits |= std::uint32_t(static_cast<unsigned char>(at[i])) << 8 * i;
    switch (type) {
    case SampleType::half: {
        Imath::half half;
        half.setBits(std::uint16_t(bits));
        return half;
    }
    case SampleType::u16: return float(bits) * (1 / 65535.0f);
    case SampleType::i16: return std::max(-1.0f, float(std::int16_t(bits)) * (1 / 32767.0f)); // -32768 is -1 too
    default: return std::bit_cast<float>(bits);
    }
}

/// The largest level of the face that begins at `offset`.
void read_samples(const PictureFile& file, const DdsHeader& header, std::int64_t offset, float* to) {
    std::string row(std::size_t(header.width * header.texel_bytes), '\0');
    const auto row_size = std::int64_t(row.size()), sample_bytes = std::int64_t(bits_of(header.type) / 8);
    for (std::int64_t y = 0; y < header.height; ++y) {
        if (y % 256 == 0) throw_if_interrupted();
        if (file.read(offset + y * row_size, row.data(), row_size) != row_size)
            throw unreadable(file.path(), "is cut short");
        for (std::int64_t at = 0; at < row_size; at += sample_bytes) *to++ = sample_at(row.data() + at, header.type);
    }
}

} // namespace

bool read_dds(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    const DdsHeader header = read_dds_header(file);
    if (header.block_bytes > 0) return false;
    describe(file, header, limits, info);
    if (!image) return true;
    *image = Image<float>(info.width, info.height, int(header.channels.size()));
    for (std::int64_t face = 0; face < header.faces; ++face) {
        float* const to = image->row(int(face * header.height));
        MaskedTexels texels = masked_texels(header);
        texels.offset += face * header.face_bytes;
        if (header.masks.empty()) read_samples(file, header, texels.offset, to);
        else read_masked(file, texels, to);
    }
    return true;
}

} // namespace bake
