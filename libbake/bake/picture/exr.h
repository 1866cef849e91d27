// Reads and writes OpenEXR by its own library, which loads in 3 ms; OpenImageIO takes 0.2 s to load.
#pragma once
#include "bake/base/output_file.h"
#include "bake/picture/picture_file.h"
#include <memory>
#include <optional>

namespace bake {

/// Fills `info` from the header, and `image`, when given, as read_image does. Returns false for a file that needs
/// OpenImageIO: deep pictures, luminance and chroma, integers. Throws as read_image.
bool read_exr(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);

/// Writes rows from the top down, and levels from the largest on. The same rows give the same bytes.
class ExrWriter {
public:
    /// Writes to `file`, which is empty; messages name `path`. The depth is half or float32.
    /// All functions throw Error{Refusal::unwritable}.
    ExrWriter(const std::string& path, const OutputFile& file, const PictureSize& size, const WriteOptions& options);
    ~ExrWriter();
    ExrWriter(const ExrWriter&) = delete;
    ExrWriter& operator=(const ExrWriter&) = delete;

    /// `rows` rows of floats.
    void write(const float* values, int rows);
    void next_level();
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace bake
