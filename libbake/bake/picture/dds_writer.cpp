// Microsoft, "Programming Guide for DDS"; "DXGI_FORMAT enumeration".
#include "bake/picture/dds_writer.h"

namespace bake {
namespace {

std::uint32_t dxgi_format(TexelFormat format) noexcept {
    switch (format) {
    case TexelFormat::r8: return 61;
    case TexelFormat::rgba8: return 28;
    case TexelFormat::rgba16: return 11;
    case TexelFormat::rgb9e5: return 67;
    case TexelFormat::rgba16f: return 10;
    case TexelFormat::rg16f: return 34;
    case TexelFormat::bc6h: return 95;
    case TexelFormat::bc5: break;
    }
    return 83;
}

} // namespace

void write_dds(BlockWriter& out, TexelFormat format, const std::vector<TextureLevel>& levels, int faces) {
    constexpr std::uint32_t caps = 0x1, height = 0x2, width = 0x4, pitch = 0x8, texel_format = 0x1000,
                            level_count = 0x20000, linear_size = 0x80000;
    constexpr std::uint32_t complex = 0x8, texture = 0x1000, mipmap = 0x400000, all_faces = 0xfe00;
    constexpr std::uint32_t four_characters = 0x4, dx10 = 0x30315844, plane = 3, cube = 4;
    const TextureLevel& largest = levels[0];
    const bool blocks = format == TexelFormat::bc5 || format == TexelFormat::bc6h;
    std::uint32_t header[37] = {0x20534444, 124}; // "DDS ", and the size of what follows before the extension
    header[2] = caps | height | width | texel_format | level_count | (blocks ? linear_size : pitch);
    header[3] = std::uint32_t(largest.height);
    header[4] = std::uint32_t(largest.width);
    // Of the whole level of a face if it is compressed, else of a row.
    const std::size_t face_bytes = largest.bytes.size() / std::size_t(faces);
    header[5] = std::uint32_t(blocks ? face_bytes : face_bytes / std::size_t(largest.height));
    header[7] = std::uint32_t(levels.size());
    header[19] = 32, header[20] = four_characters, header[21] = dx10;
    header[27] = texture | (levels.size() > 1 ? complex | mipmap : faces > 1 ? complex : 0);
    header[28] = faces > 1 ? all_faces : 0;
    header[32] = dxgi_format(format), header[33] = plane, header[35] = 1; // one picture, or one cube map
    header[34] = faces > 1 ? cube : 0;
    char bytes[sizeof header], *to = bytes;
    for (const std::uint32_t word : header) put_bytes(to, word);
    out.write({bytes, sizeof bytes});
    for (std::size_t face = 0; face < std::size_t(faces); ++face)
        for (const TextureLevel& level : levels) {
            const std::size_t bytes_of_face = level.bytes.size() / std::size_t(faces);
            out.write(std::string_view(level.bytes).substr(face * bytes_of_face, bytes_of_face));
        }
}

} // namespace bake
