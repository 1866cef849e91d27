#include "bake/picture/dds.h"
#include "bake/base/progress.h"
#include "bake/picture/bc5.h"
#include "bake/picture/dds_header.h"
#include "bake/picture/ktx2_header.h"
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
    info.channels = header.bc5 ? std::vector<std::string>{"R", "G", "B"} : header.channels;
    info.alpha_channel = header.alpha_channel;
    const auto before_alpha = int(info.channels.size()) - (header.alpha_channel >= 0 ? 1 : 0);
    info.colours = before_alpha == 1 || before_alpha == 3 ? before_alpha : 0;
    const Window window{0, 0, int(header.width), int(header.height * header.faces)};
    check_size(file.path(), file.size(), {window, window, int(info.channels.size())}, limits);
    info.type = header.bc5 ? SampleType::float32 : header.type, info.bits = bits_of(info.type);
    if (header.bc5) info.notes.push_back("is compressed as BC5: z is computed from x and y");
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

/// The same of BC5.
void read_blocks(const PictureFile& file, const DdsHeader& header, std::int64_t offset, float* to) {
    Image<float> normals(int(header.width), int(header.height), 3);
    std::string blocks(bc5_bytes(normals.width(), normals.height()), '\0');
    if (file.read(offset, blocks.data(), std::int64_t(blocks.size())) != std::int64_t(blocks.size()))
        throw unreadable(file.path(), "is cut short");
    bc5_decode(blocks.data(), normals);
    for (std::size_t i = 0; i < normals.size(); ++i) to[i] = 0.5f * normals.data()[i] + 0.5f;
}

void read_levels(const PictureFile& file, const DdsHeader& header, const ReadLimits& limits, ImageInfo& info,
                 Image<float>* image) {
    describe(file, header, limits, info);
    if (!image) return;
    *image = Image<float>(info.width, info.height, int(info.channels.size()));
    for (std::int64_t face = 0; face < header.faces; ++face) {
        float* const to = image->row(int(face * header.height));
        MaskedTexels texels = masked_texels(header);
        texels.offset += face * header.face_bytes;
        if (header.bc5) read_blocks(file, header, texels.offset, to);
        else if (header.masks.empty()) read_samples(file, header, texels.offset, to);
        else read_masked(file, texels, to);
    }
}

} // namespace

bool read_dds(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    const DdsHeader header = read_dds_header(file);
    if (header.block_bytes > 0 && !header.bc5) return false;
    info.format = "dds";
    read_levels(file, header, limits, info, image);
    return true;
}

void read_ktx2(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    info.format = "ktx2";
    read_levels(file, read_ktx2_header(file), limits, info, image);
}

} // namespace bake
