// Writes TIFF by libtiff: strips, or tiles and mip levels. Uncompressed samples are written directly.
#pragma once
#include "bake/base/output_file.h"
#include "bake/picture/image_types.h"
#include "bake/picture/tiff_file.h"
#include <string>
#include <vector>

namespace bake {

/// Writes rows of the stored type from the top down, and levels from the largest on. The same rows always give the same
/// bytes.
class TiffWriter {
public:
    /// Writes to `file`, which is empty; messages name `path`. Throws Error{Refusal::unwritable}, as all functions here.
    TiffWriter(const std::string& path, const OutputFile& file, const PictureSize& size, const WriteOptions& options);
    ~TiffWriter();
    TiffWriter(const TiffWriter&) = delete;
    TiffWriter& operator=(const TiffWriter&) = delete;

    /// With mips, all calls but the last of a level have a multiple of 64 rows.
    void write(const void* values, int rows);
    void next_level();
    void finish();

private:
    bool close_files() noexcept;
    void describe_level();
    void write_raw_strips(const unsigned char* from, int rows);
    void write_strips(const unsigned char* from, int rows);
    void write_tiles(const unsigned char* from, int rows);
    void flush_strip();
    std::size_t row_bytes() const noexcept { return std::size_t(width_) * texel_bytes_; }
    [[noreturn]] void fail(const std::string& why) const;

    std::string path_;
    WriteOptions options_;
    TiffMessages messages_;
    int width_, height_, channels_, level_ = 0, row_ = 0;
    std::size_t texel_bytes_;
    std::vector<unsigned char> waiting_; ///< rows of a strip that is not full, or a tile
    int file_;
    TIFF* tiff_ = nullptr;
};

} // namespace bake
