#include "bake/picture/dds.h"
#include "bake/base/progress.h"
#include "bake/picture/bc5.h"
#include "bake/picture/bc6h.h"
#include "bake/picture/dds_header.h"
#include "bake/picture/ktx2_header.h"
#include "bake/picture/masked_texels.h"
#include "bake/picture/rgb9e5.h"
#include <algorithm>
#include <bit>
#include <cstring>
#include <half.h>

namespace bake {
namespace {

/// A level of one face.
struct Part {
    std::int64_t width, height, offset;
};

Part part_of(const DdsHeader& header, std::int64_t level, std::int64_t face) noexcept {
    return {std::max<std::int64_t>(1, header.width >> level), std::max<std::int64_t>(1, header.height >> level),
            header.level_at[std::size_t(level)] + face * header.face_step[std::size_t(level)]};
}

MaskedTexels masked_texels(const DdsHeader& header, const Part& part) {
    return {.width = part.width,
            .height = part.height,
            .offset = part.offset,
            .row_bytes = part.width * header.texel_bytes,
            .texel_bytes = header.texel_bytes,
            .masks = header.masks};
}

/// Names of the channels as they are read.
std::vector<std::string> channels_of(const DdsHeader& header) {
    return header.code == TexelCode::samples ? header.channels : std::vector<std::string>{"R", "G", "B"};
}

int bits_of(SampleType type) noexcept { return type == SampleType::float32 ? 32 : 16; }

/// The faces of the largest level below each other.
Window largest_window(const DdsHeader& header) { return {0, 0, int(header.width), int(header.height * header.faces)}; }

void describe(const PictureFile& file, const DdsHeader& header, const ReadLimits& limits, ImageInfo& info) {
    info.channels = channels_of(header);
    info.alpha_channel = header.alpha_channel;
    const auto before_alpha = int(info.channels.size()) - (header.alpha_channel >= 0 ? 1 : 0);
    info.colours = before_alpha == 1 || before_alpha == 3 ? before_alpha : 0;
    const Window window = largest_window(header);
    check_size(file.path(), file.size(), {window, window, int(info.channels.size())}, limits);
    info.type = header.code == TexelCode::samples ? header.type : SampleType::float32, info.bits = bits_of(info.type);
    if (header.code == TexelCode::bc5) info.notes.push_back("is compressed as BC5: z is computed from x and y");
    if (!header.masks.empty()) describe_masked(file, masked_texels(header, part_of(header, 0, 0)), limits, info);
    info.width = window.width, info.height = window.height;
    info.record = header.record;
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

void read_all(const PictureFile& file, std::int64_t offset, std::string& bytes) {
    if (file.read(offset, bytes.data(), std::int64_t(bytes.size())) != std::int64_t(bytes.size()))
        throw unreadable(file.path(), "is cut short");
}

void read_samples(const PictureFile& file, const DdsHeader& header, const Part& part, float* to) {
    std::string row(std::size_t(part.width * header.texel_bytes), '\0');
    const auto row_size = std::int64_t(row.size()), sample_bytes = std::int64_t(bits_of(header.type) / 8);
    for (std::int64_t y = 0; y < part.height; ++y) {
        if (y % 256 == 0) throw_if_interrupted();
        read_all(file, part.offset + y * row_size, row);
        for (std::int64_t at = 0; at < row_size; at += sample_bytes) *to++ = sample_at(row.data() + at, header.type);
    }
}

void read_shared_exponents(const PictureFile& file, const Part& part, float* to) {
    std::string bytes(std::size_t(part.width * part.height * 4), '\0');
    read_all(file, part.offset, bytes);
    for (std::size_t at = 0; at < bytes.size(); at += 4)
        for (const float value : rgb9e5_decode(little_endian(bytes, at, 4))) *to++ = value;
}

void read_blocks(const PictureFile& file, TexelCode code, const Part& part, float* to) {
    Image<float> texels(int(part.width), int(part.height), 3);
    std::string blocks(bc6h_bytes(texels.width(), texels.height()), '\0'); // BC5 has as many
    read_all(file, part.offset, blocks);
    if (code == TexelCode::bc6h) bc6h_decode(blocks.data(), texels);
    else bc5_decode(blocks.data(), texels);
    for (std::size_t i = 0; i < texels.size(); ++i)
        to[i] = code == TexelCode::bc6h ? texels.data()[i] : 0.5f * texels.data()[i] + 0.5f;
}

/// The faces below each other.
Image<float> read_level(const PictureFile& file, const DdsHeader& header, std::int64_t level) {
    const Part first = part_of(header, level, 0);
    Image<float> image(int(first.width), int(first.height * header.faces), int(channels_of(header).size()));
    for (std::int64_t face = 0; face < header.faces; ++face) {
        const Part part = part_of(header, level, face);
        float* const to = image.row(int(face * part.height));
        if (header.code == TexelCode::rgb9e5) read_shared_exponents(file, part, to);
        else if (header.code != TexelCode::samples) read_blocks(file, header.code, part, to);
        else if (header.masks.empty()) read_samples(file, header, part, to);
        else read_masked(file, masked_texels(header, part), to);
    }
    return image;
}

void read_largest(const PictureFile& file, const DdsHeader& header, const ReadLimits& limits, ImageInfo& info,
                  Image<float>* image) {
    describe(file, header, limits, info);
    if (image) *image = read_level(file, header, 0);
}

std::vector<Image<float>> read_levels(const PictureFile& file, const DdsHeader& header) try {
    const auto channels = int(channels_of(header).size());
    if (channels == 0)
        throw Error(Refusal::unsuitable, file.path() + ": is compressed in a way whose levels are not read here; give "
                                                       "one of RGB9E5, half floats or unsigned BC6H");
    const Window window = largest_window(header);
    check_size(file.path(), file.size(), {window, window, channels}, within_memory({}));
    std::vector<Image<float>> levels;
    for (std::int64_t level = 0; level < header.levels; ++level) levels.push_back(read_level(file, header, level));
    return levels;
} catch (const std::bad_alloc&) {
    throw out_of_memory(file.path());
}

} // namespace

bool read_dds(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    const DdsHeader header = read_dds_header(file);
    if (header.block_bytes > 0 && header.code == TexelCode::samples) return false;
    info.format = "dds";
    read_largest(file, header, limits, info, image);
    return true;
}

void read_ktx2(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    info.format = "ktx2";
    read_largest(file, read_ktx2_header(file), limits, info, image);
}

std::vector<Image<float>> read_dds_levels(const PictureFile& file) { return read_levels(file, read_dds_header(file)); }

std::vector<Image<float>> read_ktx2_levels(const PictureFile& file) {
    return read_levels(file, read_ktx2_header(file));
}

} // namespace bake
