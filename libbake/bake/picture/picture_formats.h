// OpenImageIO's room: every format but plain TIFF.
//
// It is a library of its own, bake_formats.so, loaded on first need from beside the program: the 260 libraries that
// Debian's OpenImageIO brings take 0.2 s to load, longer than most of what bake does without them.
#pragma once
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"
#include <memory>

namespace bake {

struct PictureSize {
    int width = 0, height = 0, channels = 0;
};

/// A file being written.
struct FormatWriter;

/// What the room offers. Reading is as image_io.h says of read_image_info and read_image; the options of `open` are
/// resolved: no automatic depth, a name per channel.
struct PictureFormats {
    ImageInfo (*read_info)(const std::string& path, const ReadLimits& limits);
    Image<float> (*read)(const std::string& path, ImageInfo& info, const ReadLimits& limits);
    /// Writes to `temporary`; messages name `path`. Throws as ImageWriter.
    std::shared_ptr<FormatWriter> (*open)(const std::string& path, const std::string& temporary,
                                          const PictureSize& size, const WriteOptions& options);
    /// `rows` rows of levels of the stored type for integer depths, of floats otherwise.
    void (*write)(FormatWriter& writer, const void* values, int rows);
    void (*next_level)(FormatWriter& writer);
    void (*finish)(FormatWriter& writer);
};

} // namespace bake
