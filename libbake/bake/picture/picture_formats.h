// OpenImageIO's part of the room: what is neither PNG, plain OpenEXR nor plain TIFF.
//
// It is a library of its own, bake_formats.so, loaded on first need: the 260 libraries that Debian's OpenImageIO brings
// take 0.2 s to load, longer than most of what bake does without them. The library needs no symbol of the program that
// loads it, and no exception passes between the two: a failure is returned.
#pragma once
#include "bake/base/error.h"
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"
#include <memory>
#include <optional>

namespace bake {

struct PictureSize {
    int width = 0, height = 0, channels = 0;
};

/// A file being written.
struct FormatWriter;

/// Why a call failed; nothing when it succeeded.
struct FormatFailure {
    Refusal refusal;
    std::string message; ///< as Error's
};
using FormatResult = std::optional<FormatFailure>;

/// What the library may ask of the program while it works.
struct FormatHost {
    int threads = 1;
    bool (*interrupted)() noexcept = nullptr;
};

/// What the library offers. Reading is as image_io.h says of read_image_info and read_image; the options of `open` are
/// resolved: no automatic depth, a name per channel.
struct PictureFormats {
    FormatResult (*read_info)(const FormatHost& host, const std::string& path, const ReadLimits& limits,
                              ImageInfo& info);
    FormatResult (*read)(const FormatHost& host, const std::string& path, const ReadLimits& limits, ImageInfo& info,
                         Image<float>& image);
    /// Writes to `temporary`; messages name `path`.
    FormatResult (*open)(const FormatHost& host, const std::string& path, const std::string& temporary,
                         const PictureSize& size, const WriteOptions& options, std::shared_ptr<FormatWriter>& writer);
    /// `rows` rows of levels of the stored type for integer depths, of floats otherwise.
    FormatResult (*write)(FormatWriter& writer, const void* values, int rows);
    FormatResult (*next_level)(FormatWriter& writer);
    FormatResult (*finish)(FormatWriter& writer);
};

} // namespace bake
