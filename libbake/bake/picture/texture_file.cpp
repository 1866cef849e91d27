#include "bake/picture/texture_file.h"
#include "bake/base/text.h"
#include "bake/picture/bc5.h"
#include "bake/picture/bc6h.h"
#include "bake/picture/dds.h"
#include "bake/picture/dds_writer.h"
#include "bake/picture/ktx2_writer.h"
#include "bake/picture/rgb9e5.h"
#include <half.h>

namespace bake {
namespace {

/// Whole numbers of `bytes` bytes, low byte first. A picture of three channels gets a fourth, 1.
std::string integers(const Image<float>& values, int read, int written, int bytes) {
    const std::size_t row_bytes = std::size_t(values.width()) * written * bytes;
    std::string out(row_bytes * values.height(), '\xff');
    const float largest = bytes == 1 ? 255 : 65535;
    for_rows(values.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            char* to = out.data() + std::size_t(y) * row_bytes;
            for (int x = 0; x < values.width(); ++x, to += written * bytes)
                for (int c = 0; c < read; ++c) {
                    // Written so that NaN becomes 0.
                    const float value = values.at(x, y, c), clamped = value > 0 ? std::min(value, 1.0f) : 0.0f;
                    const int level = int(clamped * largest + 0.5f);
                    for (int i = 0; i < bytes; ++i) to[c * bytes + i] = char(level >> 8 * i);
                }
        }
    });
    return out;
}

void append_half(char*& to, float value) noexcept {
    // Written so that NaN becomes 0.
    const float clamped = value > -65504 ? std::min(value, 65504.0f) : value <= -65504 ? -65504.0f : 0.0f;
    const std::uint16_t bits = Imath::half(clamped).bits();
    *to++ = char(bits), *to++ = char(bits >> 8);
}

/// Half floats; a picture of three channels gets a fourth, 1.
std::string halves(const Image<float>& values, int read, int written) {
    std::string out(std::size_t(values.width()) * values.height() * written * 2, '\0');
    char* to = out.data();
    for (int y = 0; y < values.height(); ++y)
        for (int x = 0; x < values.width(); ++x)
            for (int c = 0; c < written; ++c) append_half(to, c < read ? values.at(x, y, c) : 1.0f);
    return out;
}

std::string shared_exponents(const Image<float>& values) {
    std::string out(std::size_t(values.width()) * values.height() * 4, '\0');
    char* to = out.data();
    for (int y = 0; y < values.height(); ++y)
        for (int x = 0; x < values.width(); ++x)
            put_bytes(to, rgb9e5_encode({values.at(x, y, 0), values.at(x, y, 1), values.at(x, y, 2)}));
    return out;
}

} // namespace

std::optional<TextureContainer> texture_container(const std::string& path) {
    const std::string end = ending(path);
    if (end == ".dds") return TextureContainer::dds;
    if (end == ".ktx2") return TextureContainer::ktx2;
    return {};
}

TextureLevel pack_level(const Image<float>& values, TexelFormat format) {
    TextureLevel level{values.width(), values.height()};
    switch (format) {
    case TexelFormat::r8: level.bytes = integers(values, 1, 1, 1); break;
    case TexelFormat::rgba8: level.bytes = integers(values, 3, 4, 1); break;
    case TexelFormat::rgba16: level.bytes = integers(values, 3, 4, 2); break;
    case TexelFormat::bc5: level.bytes = bc5_encode(values); break;
    case TexelFormat::rgb9e5: level.bytes = shared_exponents(values); break;
    case TexelFormat::rgba16f: level.bytes = halves(values, 3, 4); break;
    case TexelFormat::rg16f: level.bytes = halves(values, 2, 2); break;
    case TexelFormat::bc6h: level.bytes = bc6h_encode(values); break;
    }
    return level;
}

void write_texture(BlockWriter& out, TextureContainer container, TexelFormat format,
                   const std::vector<TextureLevel>& levels, int faces, const Facts& facts) {
    if (container == TextureContainer::dds) write_dds(out, format, levels, faces);
    else write_ktx2(out, format, levels, faces, facts);
}

Image<float> read_back(BlockWriter& out, const std::string& path, TextureContainer container) {
    const PictureFile file(out.descriptor(), path);
    ImageInfo info;
    Image<float> image;
    if (container == TextureContainer::dds) read_dds(file, {}, info, &image);
    else read_ktx2(file, {}, info, &image);
    return image;
}

std::vector<Image<float>> read_back_levels(BlockWriter& out, const std::string& path, TextureContainer container) {
    const PictureFile file(out.descriptor(), path);
    return container == TextureContainer::dds ? read_dds_levels(file) : read_ktx2_levels(file);
}

} // namespace bake
