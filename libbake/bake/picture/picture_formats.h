// Reads and writes by OpenImageIO the formats that no other reader here handles.
//
// It is a library of its own, bake_formats.so, loaded on first need: the 260 libraries that Debian's OpenImageIO brings
// take 0.2 s to load, longer than most bakes. The library needs no symbol of the program that loads it, and no
// exception passes between the two: failures are returned.
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

/// The functions of the library. Reading is as read_image_info() and read_image() in image_io.h. The options of `open`
/// are resolved: the depth is not automatic, and every channel has a name.
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
