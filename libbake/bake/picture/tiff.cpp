#include "bake/picture/tiff.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include "bake/picture/tiff_header.h"
#include "bake/picture/tiff_pages.h"
#include "bake/picture/upright.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <new>
#include <numeric>
#include <vector>

namespace bake {
namespace {

using Bytes = std::vector<unsigned char>;

/// Most samples that one stored byte can stand for.
double most_per_byte(const TiffHeader& header) {
    switch (header.compression) {
    case COMPRESSION_NONE:
    case COMPRESSION_LZW:
    case COMPRESSION_PACKBITS:
    case COMPRESSION_DEFLATE:
    case COMPRESSION_ADOBE_DEFLATE:
    case COMPRESSION_JPEG: return 4096.0 * std::max(1, 8 / header.samples.bits);
    default: return 1 << 16; // blank pages of facsimiles, runs of Zstandard
    }
}

/// Rows of samples as they are stored become rows of channels.
class RowDecoder {
public:
    RowDecoder(const TiffHeader& header, Image<float>& image)
        : samples_(header.samples), image_(image), direct_(are_channels(samples_)) {
        if (!direct_) floats_.resize(std::size_t(image.width()) * std::size_t(samples_.per_texel));
    }
    /// Texels from (x, y) on, their samples one after another.
    void texels(const unsigned char* from, int x, int y, int count, bool swapped = false) {
        float* const to = direct_ ? &image_.at(x, y) : floats_.data();
        to_floats(samples_, from, to, std::int64_t(count) * samples_.per_texel, swapped);
        if (!direct_) to_channels(samples_, to, &image_.at(x, y), count);
    }
    /// The samples of one plane, into their places among those of an image of samples.
    void plane(const unsigned char* from, int sample, int x, int y, int count) {
        line_.resize(std::size_t(count));
        to_floats(samples_, from, line_.data(), count, false);
        float* to = &image_.at(x, y, sample);
        for (int i = 0; i < count; ++i, to += image_.channels()) *to = line_[std::size_t(i)];
    }

private:
    const TiffSamples& samples_;
    Image<float>& image_;
    bool direct_;
    std::vector<float> floats_, line_;
};

/// Uncompressed strips, whose samples lie in the file as they do in memory, or with their bytes swapped.
bool is_plain(const TiffFile& tiff, const TiffHeader& header) {
    return header.compression == COMPRESSION_NONE && !header.tiled && !header.planes && !header.by_rgba &&
           header.samples.bits >= 8 && header.samples.bits % 8 == 0 && header.samples.bits != 24 &&
           header.samples.photometric != PHOTOMETRIC_YCBCR &&
           tiff.value<std::uint16_t>(TIFFTAG_FILLORDER) != FILLORDER_LSB2MSB;
}

void read_plain(const TiffFile& tiff, const TiffHeader& header, Image<float>& image) {
    const int columns = image.width(), height = image.height();
    const std::int64_t row_bytes = std::int64_t(columns) * header.samples.per_texel * (header.samples.bits / 8);
    const std::int64_t per_strip = std::clamp(header.rows_per_strip, 1, height);
    const bool swapped = TIFFIsByteSwapped(tiff.get());
    std::vector<std::int64_t> strips;
    for (std::uint32_t i = 0; i < TIFFNumberOfStrips(tiff.get()); ++i)
        strips.push_back(std::int64_t(TIFFGetStrileOffset(tiff.get(), i)));
    const bool as_stored = header.samples.format == SAMPLEFORMAT_IEEEFP && header.samples.bits == 32 && !swapped &&
                           are_channels(header.samples);
    // Pieces small enough to stay in the cache between reading and converting.
    for_rows(height, std::max<std::int64_t>(1, (1 << 18) / row_bytes), [&](std::int64_t begin, std::int64_t end) {
        Bytes bytes(as_stored ? 0 : std::size_t((end - begin) * row_bytes));
        RowDecoder decoder(header, image);
        for (std::int64_t y = begin, last; y < end; y = last) {
            const std::int64_t strip = y / per_strip;
            last = std::min(end, (strip + 1) * per_strip);
            char* const to =
                as_stored ? reinterpret_cast<char*>(image.row(int(y))) : reinterpret_cast<char*>(bytes.data());
            const std::int64_t size = (last - y) * row_bytes;
            if (tiff.file().read(strips[std::size_t(strip)] + (y - strip * per_strip) * row_bytes, to, size) != size)
                throw unreadable(tiff.file().path(), "cannot be read to its end", "was it being written? run again");
            for (std::int64_t row = y; row < last && !as_stored; ++row)
                decoder.texels(bytes.data() + (row - y) * row_bytes, 0, int(row), columns, swapped);
        }
    });
}

void read_strips(TiffFile& tiff, const TiffHeader& header, Image<float>& image) {
    Bytes bytes(std::size_t(TIFFScanlineSize64(tiff.get())));
    RowDecoder decoder(header, image);
    const int planes = header.planes ? header.samples.per_texel : 1;
    // Plane after plane: libtiff decodes a strip from its first row on.
    for (int plane = 0; plane < planes; ++plane)
        for (int y = 0; y < image.height(); ++y) {
            if (y % 256 == 0) throw_if_interrupted();
            if (TIFFReadScanline(tiff.get(), bytes.data(), std::uint32_t(y), std::uint16_t(plane)) != 1)
                tiff.fail(tiff.messages().error);
            if (header.planes) decoder.plane(bytes.data(), plane, 0, y, image.width());
            else decoder.texels(bytes.data(), 0, y, image.width());
        }
}

void read_tiles(TiffFile& tiff, const TiffHeader& header, Image<float>& image) {
    const auto width = int(std::min<std::uint32_t>(tiff.value<std::uint32_t>(TIFFTAG_TILEWIDTH), 1 << 24)),
               height = int(std::min<std::uint32_t>(tiff.value<std::uint32_t>(TIFFTAG_TILELENGTH), 1 << 24));
    if (width < 1 || height < 1) tiff.fail("has tiles without a size");
    const auto row_bytes = std::size_t(TIFFTileRowSize64(tiff.get()));
    Bytes bytes(std::size_t(TIFFTileSize64(tiff.get())));
    RowDecoder decoder(header, image);
    const int planes = header.planes ? header.samples.per_texel : 1;
    for (int plane = 0; plane < planes; ++plane)
        for (int top = 0; top < image.height(); top += height)
            for (int left = 0; left < image.width(); left += width) {
                throw_if_interrupted();
                if (TIFFReadTile(tiff.get(), bytes.data(), std::uint32_t(left), std::uint32_t(top), 0,
                                 std::uint16_t(plane)) < 0)
                    tiff.fail(tiff.messages().error);
                const int columns = std::min(width, image.width() - left);
                for (int y = top; y < std::min(image.height(), top + height); ++y) {
                    const unsigned char* const row = bytes.data() + std::size_t(y - top) * row_bytes;
                    if (header.planes) decoder.plane(row, plane, left, y, columns);
                    else decoder.texels(row, left, y, columns);
                }
            }
}

/// Colours that libtiff converts to 8 bits of RGB.
void read_by_rgba(TiffFile& tiff, const TiffHeader& header, Image<float>& image) {
    const int width = image.width();
    std::vector<std::uint32_t> raster(std::size_t(width) * std::size_t(image.height()));
    // In the file's own orientation, so that nothing is turned here.
    if (TIFFReadRGBAImageOriented(tiff.get(), std::uint32_t(width), std::uint32_t(image.height()), raster.data(),
                                  std::clamp(header.orientation, 1, 8), 1) != 1)
        tiff.fail(tiff.messages().error);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < width; ++x) {
            const std::uint32_t texel = raster[std::size_t(y) * std::size_t(width) + std::size_t(x)];
            image.at(x, y, 0) = float(TIFFGetR(texel)) / 255;
            image.at(x, y, 1) = float(TIFFGetG(texel)) / 255;
            image.at(x, y, 2) = float(TIFFGetB(texel)) / 255;
        }
}

std::int64_t count_rows(const Image<float>& image, int channel, auto&& is_counted) {
    std::vector<std::int64_t> counts(std::size_t(image.height()));
    for_rows(image.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < image.width(); ++x) counts[std::size_t(y)] += is_counted(image.at(x, y, channel));
    });
    return std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
}

void tell_nodata(const TiffHeader& header, const Image<float>& image, ImageInfo& info) {
    if (header.nodata.empty()) return;
    char* end = nullptr;
    const double value = std::strtod(header.nodata.c_str(), &end);
    if (end == header.nodata.c_str()) return;
    const double step = level_step(info);
    double wanted = step > 0 ? value * step : value;
    if (header.samples.photometric == PHOTOMETRIC_MINISWHITE)
        wanted = header.samples.format == SAMPLEFORMAT_INT ? -wanted : 1 - wanted;
    const double margin = step > 0 ? step / 2 : std::abs(wanted) * 1e-6;
    const std::int64_t count = count_rows(image, 0, [&](float v) {
        return std::isnan(wanted) ? std::isnan(v) : std::abs(v - wanted) <= margin || double(v) == wanted;
    });
    std::string name = header.nodata;
    while (!name.empty() && name.back() == ' ') name.pop_back();
    info.notes.push_back("states " + name + " for texels without data (GDAL_NODATA): " + std::to_string(count) +
                         (count == 1 ? " texel has it" : " texels have it") +
                         (count > 0 ? ", taken as its value" : ""));
}

void tell_associated_alpha(const TiffHeader& header, const Image<float>& image, ImageInfo& info) {
    if (!header.associated_alpha || info.alpha_channel < 0) return;
    if (const std::int64_t count = count_rows(image, info.alpha_channel, [](float v) { return v < 1; }); count > 0)
        info.notes.push_back("has colours multiplied by alpha (associated), which are taken as stored: " +
                             std::to_string(count) + " texels have an alpha below 1");
}

/// The texels of the current directory as they are stored.
Image<float> read_texels(TiffFile& tiff, const TiffHeader& header) {
    const int width = header.data.width, height = header.data.height, channels = channel_count(header.samples);
    // Planes are put together as samples first.
    Image<float> stored(width, height, header.planes ? header.samples.per_texel : channels);
    if (is_plain(tiff, header)) read_plain(tiff, header, stored);
    else if (header.by_rgba) read_by_rgba(tiff, header, stored);
    else if (header.tiled) read_tiles(tiff, header, stored);
    else read_strips(tiff, header, stored);
    const TiffMessages& said = tiff.messages();
    if (said.cut_short || !said.error.empty()) tiff.fail(said.error.empty() ? "is cut short" : said.error);
    if (!header.planes || are_channels(header.samples)) return stored;
    Image<float> converted(width, height, channels);
    for (int y = 0; y < height; ++y) to_channels(header.samples, stored.row(y), converted.row(y), width);
    return converted;
}

} // namespace

void read_tiff(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) try {
    TiffFile tiff(file);
    const std::string pages = choose_page(tiff);
    const TiffHeader header = read_tiff_header(tiff, info);
    if (!pages.empty()) info.notes.push_back(pages);
    info.width = header.picture.width, info.height = header.picture.height;
    const int channels = channel_count(header.samples);
    check_size(file.path(), file.size(), {header.data, header.picture, channels, most_per_byte(header)}, limits);
    check_tiff_data(tiff, header);
    turn_upright(info, header.orientation);
    if (!image) return;
    Image<float> stored = read_texels(tiff, header);
    tell_nodata(header, stored, info);
    tell_associated_alpha(header, stored, info);
    *image = upright(place(std::move(stored), header.data, header.picture), header.orientation);
} catch (const std::bad_alloc&) {
    throw out_of_memory(file.path());
}

} // namespace bake
