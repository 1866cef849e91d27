#include "bake/picture/plain_tiff.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/picture/picture_name.h"
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <tiffio.h>
#include <unistd.h>

namespace bake {
namespace {

// Tags that say nothing about the samples: names and dates. libtiff lists these apart from the tags of the baseline.
constexpr std::uint32_t remarks[] = {TIFFTAG_DOCUMENTNAME, TIFFTAG_IMAGEDESCRIPTION, TIFFTAG_MAKE,
                                     TIFFTAG_MODEL,        TIFFTAG_SOFTWARE,         TIFFTAG_DATETIME,
                                     TIFFTAG_ARTIST,       TIFFTAG_HOSTCOMPUTER,     TIFFTAG_COPYRIGHT};

// Those of the baseline that say more of the samples than is known here.
constexpr std::uint32_t unusual[] = {TIFFTAG_FILLORDER,       TIFFTAG_MINSAMPLEVALUE,  TIFFTAG_MAXSAMPLEVALUE,
                                     TIFFTAG_SMINSAMPLEVALUE, TIFFTAG_SMAXSAMPLEVALUE, TIFFTAG_TRANSFERFUNCTION,
                                     TIFFTAG_COLORMAP,        TIFFTAG_EXTRASAMPLES,    TIFFTAG_IMAGEDEPTH,
                                     TIFFTAG_SUBIFD,          TIFFTAG_XPOSITION,       TIFFTAG_YPOSITION,
                                     TIFFTAG_PAGENUMBER};

/// Keeps the first thing libtiff says, with the system's reason, and has nothing printed.
int keep_message(TIFF*, void* said, const char*, const char* format, va_list values) {
    const int reason = errno;
    char text[256];
    std::vsnprintf(text, sizeof text, format, values);
    auto& kept = *static_cast<std::string*>(said);
    if (kept.empty()) kept = reason == 0 ? text : std::string(text) + ": " + std::strerror(reason);
    return 1;
}

/// What libtiff has to say of the file until it is closed goes to `said`. The handlers are the file's own: OpenImageIO's
/// files keep theirs.
template <class Open> TIFF* open_quietly(std::string& said, Open&& open) {
    TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep_message, &said);
    TIFFOpenOptionsSetWarningHandlerExtR(options, keep_message, &said);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, 1 << 26);
    errno = 0;
    TIFF* const tiff = open(options);
    TIFFOpenOptionsFree(options);
    return tiff;
}

/// The first directory of a file of uncompressed strips; `tiff` is null for others.
struct Strips {
    std::string said;
    TIFF* tiff = nullptr;
    std::int64_t stored = 0, height = 0, per_strip = 0; ///< bytes of the file; rows

    explicit Strips(const std::string& path) {
        std::error_code failed;
        if (!std::filesystem::is_regular_file(path, failed)) return;
        stored = std::int64_t(std::filesystem::file_size(path, failed));
        // Not mapped, as the file may shrink, and strips as they are stored.
        tiff = open_quietly(said, [&](TIFFOpenOptions* options) { return TIFFOpenExt(path.c_str(), "rmc", options); });
        if (!tiff) return;
        height = get<std::uint32_t>(TIFFTAG_IMAGELENGTH),
        per_strip = std::min(get<std::uint32_t>(TIFFTAG_ROWSPERSTRIP), height);
        if (TIFFIsTiled(tiff) || per_strip < 1 || get<std::uint16_t>(TIFFTAG_COMPRESSION) != COMPRESSION_NONE) close();
    }
    ~Strips() { close(); }
    Strips(const Strips&) = delete;
    Strips& operator=(const Strips&) = delete;

    void close() {
        if (tiff) TIFFClose(tiff);
        tiff = nullptr;
    }

    /// The value of a tag or its default; -1 where it has none.
    template <class Value> std::int64_t get(std::uint32_t tag) const {
        Value value = 0;
        return TIFFGetFieldDefaulted(tiff, tag, &value) == 1 ? std::int64_t(value) : -1;
    }

    bool has(std::uint32_t tag) const {
        void* values[3]; // as many as any tag asked for has
        return TIFFGetField(tiff, tag, &values[0], &values[1], &values[2]) == 1;
    }

    std::uint32_t count() const { return TIFFNumberOfStrips(tiff); }

    /// Bytes that the rows of strip i take.
    std::int64_t needed(std::uint32_t i) const {
        const std::int64_t per_plane = (height + per_strip - 1) / per_strip;
        return std::int64_t(
            TIFFVStripSize64(tiff, std::uint32_t(std::min(per_strip, height - i % per_plane * per_strip))));
    }

    bool is_inside(std::uint32_t i) const {
        const std::uint64_t begin = TIFFGetStrileOffset(tiff, i);
        return begin <= std::uint64_t(stored) && needed(i) <= stored - std::int64_t(begin);
    }
};

template <class Level> void to_floats(const Level* levels, float* values, std::int64_t count) noexcept {
    constexpr float step = 1.0f / float(static_cast<Level>(-1));
    for (std::int64_t i = 0; i < count; ++i) values[i] = float(levels[i]) * step;
}

} // namespace

std::optional<PlainTiff> find_plain_tiff(const std::string& path, const ReadLimits& limits) {
    const Strips strips(path);
    TIFF* const file = strips.tiff;
    if (std::endian::native != std::endian::little || !file || !strips.said.empty() || TIFFIsByteSwapped(file) ||
        TIFFIsBigTIFF(file) || !TIFFLastDirectory(file))
        return {};
    for (int i = 0; i < TIFFGetTagListCount(file); ++i)
        if (!std::count(std::begin(remarks), std::end(remarks), TIFFGetTagListEntry(file, i))) return {};
    if (std::any_of(std::begin(unusual), std::end(unusual), [&](std::uint32_t tag) { return strips.has(tag); }))
        return {};

    const auto one = [&](std::uint32_t tag) { return strips.get<std::uint16_t>(tag); };
    const std::int64_t depth = one(TIFFTAG_BITSPERSAMPLE), format = one(TIFFTAG_SAMPLEFORMAT);
    const bool floats = depth == 32 && format == SAMPLEFORMAT_IEEEFP;
    const bool integers = (depth == 8 || depth == 16) && format == SAMPLEFORMAT_UINT;
    if (!(floats || integers) || strips.get<std::uint32_t>(TIFFTAG_SUBFILETYPE) > 0 ||
        one(TIFFTAG_PHOTOMETRIC) != PHOTOMETRIC_MINISBLACK || one(TIFFTAG_ORIENTATION) != ORIENTATION_TOPLEFT ||
        one(TIFFTAG_SAMPLESPERPIXEL) != 1 || one(TIFFTAG_PLANARCONFIG) != PLANARCONFIG_CONTIG)
        return {};
    const std::int64_t w = strips.get<std::uint32_t>(TIFFTAG_IMAGEWIDTH), h = strips.height;
    if (w < 1 || h < 1 || w > (1 << 20) || h > (1 << 20) || 4 * w * h > limits.max_bytes) return {};

    PlainTiff tiff;
    for (std::uint32_t i = 0; i < strips.count(); ++i) {
        if (!strips.is_inside(i) || std::int64_t(TIFFGetStrileByteCount(file, i)) < strips.needed(i)) return {};
        tiff.strips.push_back(std::int64_t(TIFFGetStrileOffset(file, i)));
    }
    if (!strips.said.empty()) return {};
    tiff.rows_per_strip = int(strips.per_strip);
    tiff.info = {.format = "tiff",
                 .width = int(w),
                 .height = int(h),
                 .channels = {"Y"},
                 .type = floats        ? SampleType::float32
                         : depth == 16 ? SampleType::u16
                                       : SampleType::u8,
                 .bits = int(depth)};
    char* description = nullptr;
    if (TIFFGetField(file, TIFFTAG_IMAGEDESCRIPTION, &description) == 1) tiff.info.description = description;
    return tiff;
}

bool is_cut_short_tiff(const std::string& path) {
    const Strips strips(path);
    if (!strips.tiff) return false;
    for (std::uint32_t i = 0; i < strips.count(); ++i)
        if (!strips.is_inside(i)) return true;
    return false;
}

Image<float> read_plain_tiff(const std::string& path, const PlainTiff& tiff) {
    // The strips are read by several threads at once, which one TIFF of libtiff does not allow.
    const struct File {
        int number;
        ~File() { close(number); }
    } file{open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    const int columns = tiff.info.width;
    const std::int64_t row_bytes = columns * (tiff.info.bits / 8);
    Image<float> image(columns, tiff.info.height, 1);
    // Pieces small enough to stay in the cache between reading and converting.
    for_rows(tiff.info.height, std::max<std::int64_t>(1, (1 << 18) / row_bytes),
             [&](std::int64_t begin, std::int64_t end) {
                 std::vector<unsigned char> levels(
                     tiff.info.type == SampleType::float32 ? 0 : std::size_t((end - begin) * row_bytes));
                 for (std::int64_t y = begin, last; y < end; y = last) {
                     const std::int64_t strip = y / tiff.rows_per_strip;
                     last = std::min(end, (strip + 1) * tiff.rows_per_strip);
                     auto* to = levels.empty() ? reinterpret_cast<unsigned char*>(image.row(int(y))) : levels.data();
                     std::int64_t at = tiff.strips[strip] + (y - strip * tiff.rows_per_strip) * row_bytes;
                     for (std::int64_t left = (last - y) * row_bytes, got; left > 0; to += got, at += got, left -= got)
                         if ((got = pread(file.number, to, std::size_t(left), at)) <= 0)
                             throw Error(Refusal::unreadable,
                                         path + ": cannot be read to its end; was it being written? run again");
                     const std::int64_t count = (last - y) * columns;
                     if (tiff.info.type == SampleType::u8) to_floats(levels.data(), image.row(int(y)), count);
                     if (tiff.info.type == SampleType::u16)
                         to_floats(reinterpret_cast<const std::uint16_t*>(levels.data()), image.row(int(y)), count);
                 }
             });
    return image;
}

namespace {

constexpr int strip_rows = 64;

std::int64_t row_bytes_of(const PictureSize& size, Depth depth) {
    return std::int64_t(size.width) * size.channels * (depth == Depth::u8 ? 1 : depth == Depth::u16 ? 2 : 4);
}

bool describe(TIFF* tiff, const PictureSize& size, const WriteOptions& options) {
    const int colours = size.channels < 3 ? 1 : 3;
    std::vector<std::uint16_t> extra; // what the channels beyond grey or rgb are
    for (int c = colours; c < size.channels; ++c)
        extra.push_back(options.channels[c] == "A" ? EXTRASAMPLE_UNASSALPHA : EXTRASAMPLE_UNSPECIFIED);
    const bool floats = options.depth != Depth::u8 && options.depth != Depth::u16;
    const auto set = [&](std::uint32_t tag, int value) { return TIFFSetField(tiff, tag, value) == 1; };
    return set(TIFFTAG_IMAGEWIDTH, size.width) && set(TIFFTAG_IMAGELENGTH, size.height) &&
           set(TIFFTAG_BITSPERSAMPLE, floats                       ? 32
                                      : options.depth == Depth::u8 ? 8
                                                                   : 16) &&
           set(TIFFTAG_SAMPLEFORMAT, floats ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT) &&
           set(TIFFTAG_COMPRESSION, COMPRESSION_NONE) &&
           set(TIFFTAG_PHOTOMETRIC, colours == 1 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB) &&
           set(TIFFTAG_SAMPLESPERPIXEL, size.channels) && set(TIFFTAG_ROWSPERSTRIP, strip_rows) &&
           set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) && set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT) &&
           (options.description.empty() ||
            TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, options.description.c_str()) == 1) &&
           (extra.empty() || TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, int(extra.size()), extra.data()) == 1);
}

} // namespace

bool fits_plain_tiff(const std::string& path, const PictureSize& size, const WriteOptions& options) {
    const std::int64_t header_room = 1 << 20;
    return std::endian::native == std::endian::little && picture_format(path) == PictureFormat::tiff && !options.mips &&
           options.compression != Compression::zip && size.width > 0 && size.height > 0 && size.channels > 0 &&
           size.height * row_bytes_of(size, options.depth) < (std::int64_t(1) << 32) - header_room;
}

PlainTiffWriter::PlainTiffWriter(const std::string& path, const std::string& temporary, const PictureSize& size,
                                 const WriteOptions& options)
    : path_(path), row_bytes_(std::size_t(row_bytes_of(size, options.depth))),
      // Not truncated: the file is empty, and ext4 writes a truncated one to the disk before it closes it.
      file_(open(temporary.c_str(), O_RDWR | O_CLOEXEC)) {
    if (file_ < 0) fail(std::strerror(errno));
    tiff_ =
        open_quietly(said_, [&](TIFFOpenOptions* with) { return TIFFFdOpenExt(file_, temporary.c_str(), "wl", with); });
    if (tiff_ && describe(tiff_, size, options)) return;
    close_files();
    fail(said_);
}

PlainTiffWriter::~PlainTiffWriter() { close_files(); }

bool PlainTiffWriter::close_files() noexcept {
    if (tiff_) TIFFCleanup(tiff_); // leaves the file open, whose closing may fail
    const bool closed = file_ < 0 || close(file_) == 0;
    tiff_ = nullptr, file_ = -1;
    return closed;
}

void PlainTiffWriter::fail(const std::string& why) const {
    throw Error(Refusal::unwritable, path_ + ": cannot be written (" + why + "); is the disk full?");
}

void PlainTiffWriter::write(const void* values, int rows) {
    const auto* from = static_cast<const unsigned char*>(values);
    for (int part; rows > 0; rows -= part, row_ += part) {
        part = std::min(rows, strip_rows - row_ % strip_rows);
        const auto bytes = tmsize_t(part * row_bytes_);
        errno = 0;
        // Appends to the strip where it was left. The samples are written from where they are, and not changed.
        if (TIFFWriteRawStrip(tiff_, std::uint32_t(row_ / strip_rows), const_cast<unsigned char*>(from), bytes) !=
            bytes)
            fail(said_);
        from += bytes;
    }
}

void PlainTiffWriter::finish() {
    errno = 0;
    if (!TIFFFlush(tiff_)) fail(said_);
    if (!close_files()) fail(std::strerror(errno));
}

} // namespace bake
