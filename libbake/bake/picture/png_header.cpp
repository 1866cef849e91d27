#include "bake/picture/png_header.h"
#include <algorithm>
#include <cstdint>
#include <fstream>

namespace bake {

std::optional<PngHeader> read_png_header(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string head(29, '\0'); // signature, and IHDR up to the colour type and beyond
    if (!file.read(head.data(), std::streamsize(head.size())) || !head.starts_with("\x89PNG")) return {};
    PngHeader header;
    const int colour_type = head[25];
    header.bits = colour_type == 3 ? 8 : head[24];
    file.seekg(33); // past IHDR's check sum
    for (std::string chunk(8, '\0'); file.read(chunk.data(), 8);) {
        const auto byte = [&](int i) { return std::uint32_t(static_cast<unsigned char>(chunk[i])); };
        const std::uint32_t size = byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
        const std::string type = chunk.substr(4);
        if (type == "IDAT") return header;
        if (type == "sRGB") header.srgb = true;
        const std::streamoff next = std::streamoff(file.tellg()) + size + 4;
        if (type == "iCCP") { // begins with the profile's name
            std::string name(std::min<std::uint32_t>(size, 79), '\0');
            file.read(name.data(), std::streamsize(name.size()));
            header.srgb = header.srgb || name.substr(0, name.find('\0')).find("sRGB") != std::string::npos;
        }
        file.seekg(next);
    }
    return {};
}

} // namespace bake
