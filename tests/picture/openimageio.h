// What OpenImageIO makes of a picture, or of one of its mip levels, in a program of its own.
#pragma once
#include "bake/picture/image.h"
#include "cli/command.h"
#include <cstring>

namespace bake::test {

inline Image<float> by_openimageio(const Folder& folder, const std::string& path, int level = 0) {
    const fs::path reader = fs::path(std::getenv("BAKE")).parent_path() / "read_mip";
    const std::string out = folder / "by_openimageio";
    REQUIRE(std::system((reader.string() + " '" + path + "' " + std::to_string(level) + " >'" + out + "'").c_str()) ==
            0);
    const std::string bytes = contents(out);
    int size[3];
    REQUIRE(bytes.size() >= sizeof size);
    std::memcpy(size, bytes.data(), sizeof size);
    Image<float> image(size[0], size[1], size[2]);
    REQUIRE(bytes.size() == sizeof size + image.size() * sizeof(float));
    std::memcpy(image.data(), bytes.data() + sizeof size, image.size() * sizeof(float));
    return image;
}

inline bool same(const Image<float>& a, const Image<float>& b) {
    return a.width() == b.width() && a.height() == b.height() && a.channels() == b.channels() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

} // namespace bake::test
