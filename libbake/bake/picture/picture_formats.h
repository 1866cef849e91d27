// Reads by OpenImageIO the formats that no other reader here handles.
//
// It is a library of its own, bake_formats.so, loaded on first need: the 260 libraries that Debian's OpenImageIO brings
// take 0.2 s to load, longer than most bakes. The library needs no symbol of the program that loads it, and no
// exception passes between the two: failures are returned.
#pragma once
#include "bake/base/error.h"
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"
#include "bake/picture/picture_file.h"
#include <optional>

namespace bake {

/// The reason why a call failed; nothing if it succeeded.
struct FormatFailure {
    Refusal refusal;
    std::string message; ///< as Error's
};
using FormatResult = std::optional<FormatFailure>;

/// What the program provides to the library.
struct FormatHost {
    int threads = 1;
    bool (*interrupted)() noexcept = nullptr;
};

/// A picture as OpenImageIO reads it. The program itself turns it upright and reads its profile.
struct FormatPicture {
    ImageInfo info;
    Image<float> image;   ///< empty unless asked for
    int orientation = 1;  ///< as in upright.h
    std::string icc = {}; ///< ICC profile, empty without one
};

/// The functions of the library. Reading is as read_image_info() and read_image() in image_io.h, except for orientation
/// and profile.
struct PictureFormats {
    FormatResult (*read)(const FormatHost& host, const PictureFile& file, const ReadLimits& limits, bool texels,
                         FormatPicture& picture);
};

} // namespace bake
