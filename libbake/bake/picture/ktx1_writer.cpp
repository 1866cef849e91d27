// Khronos, "KTX File Format Specification" 1.0.
#include "bake/picture/ktx1_writer.h"
#include <half.h>

namespace bake {

void write_ktx1_cube(BlockWriter& out, const std::vector<TextureLevel>& levels,
                     const std::vector<std::pair<std::string, std::string>>& pairs) {
    constexpr std::uint32_t half_float = 0x140b, rgba = 0x1908, rgba16f = 0x881a;
    const auto append = [](std::string& to, std::uint32_t word) {
        for (int i = 0; i < 4; ++i) to += char(word >> 8 * i);
    };
    std::string keys;
    for (const auto& [key, value] : pairs) {
        append(keys, std::uint32_t(key.size() + value.size() + 2));
        keys += key + '\0' + value + '\0';
        keys.resize((keys.size() + 3) / 4 * 4);
    }
    std::string head("\xabKTX 11\xbb\r\n\x1a\n", 12);
    for (const std::uint32_t word : {0x04030201u, half_float, 2u, rgba, rgba16f, rgba, std::uint32_t(levels[0].width),
                                     std::uint32_t(levels[0].height), 0u, // no depth
                                     0u,                                  // no array
                                     6u, std::uint32_t(levels.size()), std::uint32_t(keys.size())})
        append(head, word);
    out.write(head + keys);
    for (const TextureLevel& level : levels) {
        std::string size;
        append(size, std::uint32_t(level.bytes.size() / 6)); // of one face
        out.write(size);
        out.write(level.bytes); // faces of 8 bytes per texel need no padding
    }
}

Image<float> halves_of(const TextureLevel& level, int faces) {
    Image<float> image(level.width, level.height * faces, 4);
    for (std::size_t i = 0; i < image.size(); ++i) {
        Imath::half half;
        half.setBits(std::uint16_t(static_cast<unsigned char>(level.bytes[2 * i]) |
                                   static_cast<unsigned char>(level.bytes[2 * i + 1]) << 8));
        image.data()[i] = half;
    }
    return image;
}

} // namespace bake
