// Reads and writes pictures: PNG by libpng, OpenEXR by its own library, TIFF by libtiff, Radiance pictures, DDS that are not
// compressed and BMP with masks by readers of our own, others by OpenImageIO in a process of its own.
#pragma once
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"
#include <memory>

namespace bake {

/// Reads the header. Throws Error{Refusal::unreadable} naming the file and the reason.
ImageInfo read_image_info(const std::string& path, const ReadLimits& limits = {});

/// Reads all channels as data: unsigned integers are divided by their largest value, floats are unchanged; values are
/// not decoded from sRGB and not divided by alpha. A data window is placed in its display window (0 outside). A picture
/// that is stored turned or mirrored is turned upright. Of several pictures in a file, the first of full size is read; of
/// several layers, the main one. info->notes tells what was left out. Throws Error{Refusal::unreadable} for a file that is
/// missing, damaged, cut short or of a format that is not read, and Error{Refusal::unsuitable} for a file that exceeds `limits`.
Image<float> read_image(const std::string& path, ImageInfo* info = nullptr, const ReadLimits& limits = {});

/// Resolves `depth` for a file of this name. Throws Error{Refusal::usage} for a depth that its format cannot
/// hold (half in png, 8 bit in exr) or an ending other than .png, .exr, .tif, .tiff.
Depth resolve_depth(const std::string& path, Depth depth);

/// Writes rows from the top down, so that a large picture is never in memory as a whole. Integer depths clamp to [0,1]
/// and round to the nearest level; the caller biases signed data first. The file appears, complete, in finish().
class ImageWriter {
public:
    /// Throws Error{Refusal::unwritable} or Error{Refusal::usage}, as resolve_depth.
    ImageWriter(const std::string& path, int width, int height, int channels, const WriteOptions& options = {});
    ~ImageWriter();
    /// `rows` rows of width * channels floats.
    /// With mips, every call but the last of a level writes a multiple of 64 rows.
    void write(const float* values, int rows);
    /// Ends a level and begins the next, half as wide and high, rounded down, at least 1.
    void next_level();
    /// Completes the file, which then appears as OutputFile::commit() says.
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Writes a whole image atomically. Throws as ImageWriter.
void write_image(const std::string& path, const Image<float>& image, const WriteOptions& options = {});

} // namespace bake
