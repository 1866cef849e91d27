// Plain TIFF: uncompressed strips of samples that lie in the file as they do in memory. Heights and tables are large and
// their bakes take little longer than a copy of them, so these files are read and written here, at the speed of the disk.
//
// libtiff reads and writes what is said of the samples; the samples themselves go by it unconverted.
#pragma once
#include "bake/picture/image.h"
#include "bake/picture/picture_formats.h"
#include <optional>

struct tiff; // libtiff's

namespace bake {

/// Where the rows of a grey plain TIFF lie.
struct PlainTiff {
    ImageInfo info;
    int rows_per_strip = 0;
    std::vector<std::int64_t> strips; ///< first byte of each
};

/// Nothing for all but one grey channel of 8 or 16 bits or of floats, for any tag whose meaning is not known here, for
/// files over `limits` and for whatever does not add up: OpenImageIO then says what the file is, or what is wrong with it.
std::optional<PlainTiff> find_plain_tiff(const std::string& path, const ReadLimits& limits);

/// Whether the file is an uncompressed TIFF whose last rows are missing, which OpenImageIO reads without a word.
bool is_cut_short_tiff(const std::string& path);

/// As read_image. Throws Error{Refusal::unreadable} when the file has changed in between.
Image<float> read_plain_tiff(const std::string& path, const PlainTiff& tiff);

/// Whether PlainTiffWriter can write it: an uncompressed .tif of less than 4 GiB without mips.
bool fits_plain_tiff(const std::string& path, const PictureSize& size, const WriteOptions& options);

/// Writes rows of the stored type from the top down. The same rows always give the same bytes.
class PlainTiffWriter {
public:
    /// Writes to `temporary`; messages name `path`. Throws Error{Refusal::unwritable}.
    PlainTiffWriter(const std::string& path, const std::string& temporary, const PictureSize& size,
                    const WriteOptions& options);
    ~PlainTiffWriter();
    PlainTiffWriter(const PlainTiffWriter&) = delete;
    PlainTiffWriter& operator=(const PlainTiffWriter&) = delete;

    void write(const void* values, int rows);
    void finish();

private:
    bool close_files() noexcept;
    [[noreturn]] void fail(const std::string& why) const;

    std::string path_, said_; ///< said_: by libtiff
    std::size_t row_bytes_;
    int row_ = 0;
    int file_;
    tiff* tiff_ = nullptr;
};

} // namespace bake
