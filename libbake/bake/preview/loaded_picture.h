// A picture file in memory, so that it is read once, whatever is asked of it.
#pragma once
#include "bake/picture/image_io.h"
#include <algorithm>
#include <map>
#include <memory>
#include <string>

namespace bake {

struct LoadedPicture {
    Image<float> image; ///< as read_image() gives it
    ImageInfo info;
};

/// Files that are read already, by their names.
using LoadedPictures = std::map<std::string, std::shared_ptr<const LoadedPicture>>;

inline std::shared_ptr<const LoadedPicture> read_picture(const std::string& file) {
    auto picture = std::make_shared<LoadedPicture>();
    picture->image = read_image(file, &picture->info);
    return picture;
}

/// The file among `known`; read, if it is not.
inline std::shared_ptr<const LoadedPicture> loaded_picture(const LoadedPictures& known, const std::string& file) {
    const auto at = known.find(file);
    return at != known.end() ? at->second : read_picture(file);
}

inline Image<float> copied(const Image<float>& image) {
    Image<float> out(image.width(), image.height(), image.channels());
    std::copy_n(image.data(), image.size(), out.data());
    return out;
}

} // namespace bake
