#include "bake/picture/texture_file.h"
#include "bake/base/text.h"
#include "bake/picture/bc5.h"
#include "bake/picture/dds.h"
#include "bake/picture/dds_writer.h"
#include "bake/picture/ktx2_writer.h"

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
    }
    return level;
}

void write_texture(BlockWriter& out, TextureContainer container, TexelFormat format,
                   const std::vector<TextureLevel>& levels) {
    if (container == TextureContainer::dds) write_dds(out, format, levels);
    else write_ktx2(out, format, levels);
}

Image<float> read_back(BlockWriter& out, const std::string& path, TextureContainer container) {
    const PictureFile file(out.descriptor(), path);
    ImageInfo info;
    Image<float> image;
    if (container == TextureContainer::dds) read_dds(file, {}, info, &image);
    else read_ktx2(file, {}, info, &image);
    return image;
}

} // namespace bake
