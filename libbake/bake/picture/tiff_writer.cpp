#include "bake/picture/tiff_writer.h"
#include "bake/base/error.h"
#include "bake/picture/icc.h"
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <unistd.h>

namespace bake {
namespace {

constexpr int strip_rows = 64, tile_edge = 64;

int sample_bytes(Depth depth) noexcept { return depth == Depth::u8 ? 1 : depth == Depth::u16 ? 2 : 4; }
bool is_float(Depth depth) noexcept { return depth != Depth::u8 && depth != Depth::u16; }

/// Files of 4 GiB and more need the wide offsets of BigTIFF.
const char* mode_for(const PictureSize& size, const WriteOptions& options) {
    const double bytes = double(size.width) * size.height * size.channels * sample_bytes(options.depth);
    return bytes * (options.mips ? 1.5 : 1.0) < double((std::int64_t(1) << 32) - (1 << 24)) ? "w" : "w8";
}

bool describe_samples(TIFF* tiff, int channels, const WriteOptions& options) {
    const auto set = [&](std::uint32_t tag, int value) { return TIFFSetField(tiff, tag, value) == 1; };
    const int colours = channels < 3 ? 1 : 3;
    std::vector<std::uint16_t> extra; // what the channels beyond grey or rgb are
    for (int c = colours; c < channels; ++c)
        extra.push_back(options.channels[std::size_t(c)] == "A" ? EXTRASAMPLE_UNASSALPHA : EXTRASAMPLE_UNSPECIFIED);
    const bool floats = is_float(options.depth);
    return set(TIFFTAG_BITSPERSAMPLE, 8 * sample_bytes(options.depth)) &&
           set(TIFFTAG_SAMPLEFORMAT, floats ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT) &&
           set(TIFFTAG_PHOTOMETRIC, colours == 1 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB) &&
           set(TIFFTAG_SAMPLESPERPIXEL, channels) && set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) &&
           set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT) &&
           (extra.empty() || TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, int(extra.size()), extra.data()) == 1);
}

bool describe_storage(TIFF* tiff, const WriteOptions& options) {
    const auto set = [&](std::uint32_t tag, int value) { return TIFFSetField(tiff, tag, value) == 1; };
    const bool zip = options.compression == Compression::zip;
    if (!set(TIFFTAG_COMPRESSION, zip ? COMPRESSION_ADOBE_DEFLATE : COMPRESSION_NONE)) return false;
    if (zip && !set(TIFFTAG_PREDICTOR, is_float(options.depth) ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL))
        return false;
    return options.mips ? set(TIFFTAG_TILEWIDTH, tile_edge) && set(TIFFTAG_TILELENGTH, tile_edge)
                        : set(TIFFTAG_ROWSPERSTRIP, strip_rows);
}

bool describe_remarks(TIFF* tiff, int channels, int level, const WriteOptions& options) {
    const auto text = [&](std::uint32_t tag, const char* value) { return TIFFSetField(tiff, tag, value) == 1; };
    const std::string record = level == 0 ? record_comment(options.facts) : "";
    if (!record.empty() && !text(TIFFTAG_SOFTWARE, record.c_str())) return false;
    if (!options.description.empty() && !text(TIFFTAG_IMAGEDESCRIPTION, options.description.c_str())) return false;
    // OpenImageIO then takes the directories that follow as mip levels.
    if (options.mips && !text(TIFFTAG_PIXAR_TEXTUREFORMAT, "Plain Texture")) return false;
    if (options.colour == ColourSpace::automatic || is_float(options.depth)) return true;
    const std::string profile = make_icc(options.colour == ColourSpace::srgb, channels < 3);
    return TIFFSetField(tiff, TIFFTAG_ICCPROFILE, std::uint32_t(profile.size()), profile.data()) == 1;
}

} // namespace

TiffWriter::TiffWriter(const std::string& path, const OutputFile& file, const PictureSize& size,
                       const WriteOptions& options)
    : path_(path), options_(options), width_(size.width), height_(size.height), channels_(size.channels),
      texel_bytes_(std::size_t(size.channels) * std::size_t(sample_bytes(options.depth))),
      file_(file.open_descriptor()) {
    const TiffOptions handlers(messages_);
    tiff_ = TIFFFdOpenExt(file_, path.c_str(), mode_for(size, options), handlers.get());
    if (!tiff_) {
        close_files();
        fail(messages_.error);
    }
    try {
        describe_level();
    } catch (...) {
        close_files();
        throw;
    }
}

TiffWriter::~TiffWriter() { close_files(); }

bool TiffWriter::close_files() noexcept {
    if (tiff_) TIFFCleanup(tiff_); // leaves the file open, whose closing may fail
    const bool closed = file_ < 0 || close(file_) == 0;
    tiff_ = nullptr, file_ = -1;
    return closed;
}

void TiffWriter::fail(const std::string& why) const {
    if (errno == ENOMEM) throw std::bad_alloc();
    refuse_unwritten(path_, why);
}

void TiffWriter::describe_level() {
    const auto set = [&](std::uint32_t tag, int value) { return TIFFSetField(tiff_, tag, value) == 1; };
    if ((level_ > 0 && !set(TIFFTAG_SUBFILETYPE, FILETYPE_REDUCEDIMAGE)) || !set(TIFFTAG_IMAGEWIDTH, width_) ||
        !set(TIFFTAG_IMAGELENGTH, height_) || !describe_samples(tiff_, channels_, options_) ||
        !describe_storage(tiff_, options_) || !describe_remarks(tiff_, channels_, level_, options_))
        fail(messages_.error);
}

void TiffWriter::write_raw_strips(const unsigned char* from, int rows) {
    for (int part; rows > 0; rows -= part, row_ += part) {
        part = std::min(rows, strip_rows - row_ % strip_rows);
        const auto bytes = tmsize_t(std::size_t(part) * row_bytes());
        errno = 0;
        // Appends to the strip where it was left. The samples are written from where they are, and not changed.
        if (TIFFWriteRawStrip(tiff_, std::uint32_t(row_ / strip_rows), const_cast<unsigned char*>(from), bytes) !=
            bytes)
            fail(messages_.error);
        from += bytes;
    }
}

void TiffWriter::flush_strip() {
    if (waiting_.empty()) return;
    errno = 0;
    if (TIFFWriteEncodedStrip(tiff_, std::uint32_t((row_ - 1) / strip_rows), waiting_.data(),
                              tmsize_t(waiting_.size())) < 0)
        fail(messages_.error);
    waiting_.clear();
}

/// Whole strips at a time: libtiff then compresses them at one go, and changes the samples in doing so.
void TiffWriter::write_strips(const unsigned char* from, int rows) {
    for (; rows > 0; --rows, from += row_bytes()) {
        waiting_.insert(waiting_.end(), from, from + row_bytes());
        if (++row_ % strip_rows == 0 || row_ == height_) flush_strip();
    }
}

void TiffWriter::write_tiles(const unsigned char* from, int rows) {
    const std::size_t tile_row = texel_bytes_ * tile_edge;
    for (int top = 0; top < rows; top += tile_edge)
        for (int left = 0; left < width_; left += tile_edge) {
            waiting_.assign(tile_row * tile_edge, 0); // beyond the picture's edge
            const std::size_t covered = texel_bytes_ * std::size_t(std::min(tile_edge, width_ - left));
            for (int y = 0; y < std::min(tile_edge, rows - top); ++y)
                std::memcpy(waiting_.data() + std::size_t(y) * tile_row,
                            from + std::size_t(top + y) * row_bytes() + std::size_t(left) * texel_bytes_, covered);
            const std::uint32_t tile = TIFFComputeTile(tiff_, std::uint32_t(left), std::uint32_t(row_ + top), 0, 0);
            const auto size = tmsize_t(waiting_.size());
            errno = 0;
            const tmsize_t written = options_.compression == Compression::zip
                                         ? TIFFWriteEncodedTile(tiff_, tile, waiting_.data(), size)
                                         : TIFFWriteRawTile(tiff_, tile, waiting_.data(), size);
            if (written < 0) fail(messages_.error);
        }
    row_ += rows;
}

void TiffWriter::write(const void* values, int rows) {
    const auto* const from = static_cast<const unsigned char*>(values);
    if (options_.mips) write_tiles(from, rows);
    else if (options_.compression == Compression::zip) write_strips(from, rows);
    else write_raw_strips(from, rows);
}

void TiffWriter::next_level() {
    errno = 0;
    if (TIFFWriteDirectory(tiff_) != 1) fail(messages_.error);
    width_ = std::max(1, width_ / 2), height_ = std::max(1, height_ / 2);
    ++level_, row_ = 0;
    describe_level();
}

void TiffWriter::finish() {
    errno = 0;
    if (!TIFFFlush(tiff_)) fail(messages_.error);
    if (!close_files()) fail(std::strerror(errno));
}

} // namespace bake
