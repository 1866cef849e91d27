#include "bake/picture/tiff_header.h"
#include "bake/picture/icc.h"
#include <algorithm>
#include <bit>

namespace bake {
namespace {

constexpr std::uint32_t tag_gdal_nodata = 42113;
constexpr const char *cube_format = "CubeFace Environment", *latlong_format = "LatLong Environment";

Error unsuitable(const TiffFile& tiff, const std::string& why) {
    return Error(Refusal::unsuitable, tiff.file().path() + ": " + why);
}

std::string photometric_name(int photometric) {
    switch (photometric) {
    case PHOTOMETRIC_CIELAB:
    case PHOTOMETRIC_ICCLAB:
    case PHOTOMETRIC_ITULAB: return "L*a*b* colours";
    case PHOTOMETRIC_CFA: return "the raw samples of a camera";
    case 34892: return "the raw samples of a camera"; // LinearRaw
    default: return "colours of kind " + std::to_string(photometric);
    }
}

/// The palette as floats, and the depth of its entries, 8 or 16.
int read_palette(const TiffFile& tiff, TiffSamples& samples) {
    std::uint16_t* channels[3] = {};
    if (samples.bits > 16 || TIFFGetField(tiff.get(), TIFFTAG_COLORMAP, &channels[0], &channels[1], &channels[2]) != 1)
        tiff.fail("has no palette");
    const std::size_t count = std::size_t(1) << samples.bits;
    bool below_256 = true, eight_bits = true;
    for (std::size_t i = 0; i < count; ++i)
        for (const auto* channel : channels) {
            below_256 &= channel[i] < 256;
            eight_bits &= channel[i] % 257 == 0 || channel[i] % 256 == 0;
        }
    samples.palette.resize(3 * count);
    // Old programs write entries of 8 bits into the tag's 16; others leave the lower byte 0.
    const float largest = below_256 ? 255.0f : 65535.0f;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const float entry = channels[c][i];
            samples.palette[3 * i + c] = !below_256 && eight_bits ? float(channels[c][i] >> 8) / 255 : entry / largest;
        }
    return below_256 || eight_bits ? 8 : 16;
}

bool is_grey_ramp(const std::vector<float>& palette) {
    const std::size_t count = palette.size() / 3;
    for (std::size_t i = 0; i < palette.size(); ++i)
        if (std::abs(palette[i] - float(i / 3) / float(count - 1)) > 1e-4f) return false;
    return true;
}

void name_channels(const TiffFile& tiff, TiffHeader& header, ImageInfo& info) {
    std::uint16_t count = 0, *kinds = nullptr;
    TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
    const int channels = channel_count(header.samples);
    const bool colour =
        header.samples.photometric != PHOTOMETRIC_MINISBLACK && header.samples.photometric != PHOTOMETRIC_MINISWHITE &&
        header.samples.photometric != PHOTOMETRIC_MASK && header.samples.photometric != PHOTOMETRIC_LOGL;
    info.colours = std::min(channels, colour ? 3 : 1);
    info.channels = colour ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
    info.channels.resize(std::size_t(info.colours));
    for (int c = info.colours; c < channels; ++c) {
        // The tag lists the last samples; files with more of them than it lists exist.
        const int extra = count - (channels - c);
        const int kind = extra >= 0 && kinds ? kinds[extra] : EXTRASAMPLE_UNSPECIFIED;
        const bool alpha = info.alpha_channel < 0 && (kind == EXTRASAMPLE_ASSOCALPHA || kind == EXTRASAMPLE_UNASSALPHA);
        if (alpha) info.alpha_channel = c, header.associated_alpha = kind == EXTRASAMPLE_ASSOCALPHA;
        info.channels.push_back(alpha ? "A" : "extra" + std::to_string(c - info.colours + 1));
    }
}

ColourTag read_colour(const TiffFile& tiff, const TiffHeader& header) {
    std::uint32_t size = 0;
    void* profile = nullptr;
    if (TIFFGetField(tiff.get(), TIFFTAG_ICCPROFILE, &size, &profile) == 1 && profile)
        return read_icc({static_cast<const char*>(profile), size});
    std::uint16_t* tables[3] = {};
    if (header.samples.bits <= 16 &&
        TIFFGetField(tiff.get(), TIFFTAG_TRANSFERFUNCTION, &tables[0], &tables[1], &tables[2]) == 1) {
        ColourTag tag{.source = "TransferFunction tag"};
        for (const auto* table : tables) {
            if (!table) break;
            tag.curves.emplace_back();
            for (std::size_t i = 0; i < std::size_t(1) << header.samples.bits; ++i)
                tag.curves.back().samples.push_back(float(table[i]) / 65535);
        }
        return tag;
    }
    return {};
}

EnvironmentTag environment_tag(const TiffFile& tiff, const Window& data) {
    const std::string format = tiff.text(TIFFTAG_PIXAR_TEXTUREFORMAT);
    if (format != cube_format && format != latlong_format) return EnvironmentTag::none;
    return data.height == 6 * std::int64_t(data.width) ? EnvironmentTag::cube : EnvironmentTag::latlong;
}

void read_windows(const TiffFile& tiff, TiffHeader& header, ImageInfo& info) {
    const auto size = [](std::uint32_t value) { return int(std::min<std::uint32_t>(value, 1 << 30)); };
    header.data = {0, 0, size(tiff.value<std::uint32_t>(TIFFTAG_IMAGEWIDTH)),
                   size(tiff.value<std::uint32_t>(TIFFTAG_IMAGELENGTH))};
    info.environment = environment_tag(tiff, header.data);
    header.picture = header.data;
    // Programs that crop state the whole size in tags of their own. A position alone says where the picture lies on a
    // page, and moves no texel.
    const int width = size(tiff.value<std::uint32_t>(TIFFTAG_PIXAR_IMAGEFULLWIDTH)),
              height = size(tiff.value<std::uint32_t>(TIFFTAG_PIXAR_IMAGEFULLLENGTH));
    if (width <= 0 || height <= 0 || info.environment == EnvironmentTag::cube) return;
    header.data.x = int(std::clamp(tiff.value<float>(TIFFTAG_XPOSITION), 0.0f, 1e6f));
    header.data.y = int(std::clamp(tiff.value<float>(TIFFTAG_YPOSITION), 0.0f, 1e6f));
    header.picture = {0, 0, width, height};
}

/// Asks libtiff to decode what it can decode itself, and refuses colours that are not read.
void choose_decoding(const TiffFile& tiff, TiffHeader& header) {
    TIFF* const file = tiff.get();
    const int photometric = header.samples.photometric;
    if (!TIFFIsCODECConfigured(std::uint16_t(header.compression)))
        throw unsuitable(tiff, "is compressed by method " + std::to_string(header.compression) +
                                   ", which is not read; export it again without compression or with deflate");
    if (header.compression == COMPRESSION_SGILOG || header.compression == COMPRESSION_SGILOG24)
        TIFFSetField(file, TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT);
    if (header.compression == COMPRESSION_PIXARLOG) TIFFSetField(file, TIFFTAG_PIXARLOGDATAFMT, PIXARLOGDATAFMT_FLOAT);
    if (photometric == PHOTOMETRIC_YCBCR && header.compression == COMPRESSION_JPEG) {
        TIFFSetField(file, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
        return;
    }
    switch (photometric) {
    case PHOTOMETRIC_MINISWHITE:
    case PHOTOMETRIC_MINISBLACK:
    case PHOTOMETRIC_RGB:
    case PHOTOMETRIC_PALETTE:
    case PHOTOMETRIC_MASK:
    case PHOTOMETRIC_SEPARATED:
    case PHOTOMETRIC_LOGL:
    case PHOTOMETRIC_LOGLUV: return;
    default: break;
    }
    char why[1024] = {};
    header.by_rgba = TIFFRGBAImageOK(file, why) == 1;
    if (!header.by_rgba)
        throw unsuitable(tiff, "holds " + photometric_name(photometric) + "; export it again as grey or RGB");
}

} // namespace

TiffHeader read_tiff_header(TiffFile& tiff, ImageInfo& info) {
    TiffHeader header;
    const auto number = [&](std::uint32_t tag) { return int(tiff.value<std::uint16_t>(tag)); };
    header.compression = number(TIFFTAG_COMPRESSION);
    header.samples.photometric = number(TIFFTAG_PHOTOMETRIC);
    choose_decoding(tiff, header);
    header.samples.bits = number(TIFFTAG_BITSPERSAMPLE), header.samples.format = number(TIFFTAG_SAMPLEFORMAT);
    header.samples.per_texel = number(TIFFTAG_SAMPLESPERPIXEL);
    header.orientation = number(TIFFTAG_ORIENTATION);
    header.tiled = TIFFIsTiled(tiff.get());
    header.planes = number(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE && header.samples.per_texel > 1;
    header.rows_per_strip = int(std::min<std::uint32_t>(tiff.value<std::uint32_t>(TIFFTAG_ROWSPERSTRIP), 1 << 30));
    header.nodata = tiff.text(tag_gdal_nodata);
    read_windows(tiff, header, info);
    if (tiff.value<std::uint32_t>(TIFFTAG_IMAGEDEPTH) > 1) throw unsuitable(tiff, "is a volume; give a flat image");
    if (header.samples.per_texel < 1 || header.data.width < 1 || header.data.height < 1) tiff.fail("has no pixels");
    if (header.by_rgba) header.samples = {.photometric = PHOTOMETRIC_RGB, .per_texel = 3}, header.planes = false;
    if (!is_known(header.samples))
        throw unsuitable(tiff, "has samples of " + std::to_string(header.samples.bits) + " bits and format " +
                                   std::to_string(header.samples.format) + ", which are not read; export it again");
    info.format = "tiff";
    info.type = sample_type(header.samples), info.bits = header.samples.bits;
    if (header.samples.photometric == PHOTOMETRIC_PALETTE) {
        info.bits = read_palette(tiff, header.samples);
        info.type = info.bits == 8 ? SampleType::u8 : SampleType::u16;
        info.palette = !is_grey_ramp(header.samples.palette);
    }
    name_channels(tiff, header, info);
    info.description = tiff.text(TIFFTAG_IMAGEDESCRIPTION);
    info.record = record_in(tiff.text(TIFFTAG_SOFTWARE));
    info.colour = read_colour(tiff, header);
    info.srgb_tagged = info.colour.is_srgb();
    return header;
}

void check_tiff_data(const TiffFile& tiff, const TiffHeader& header) {
    TIFF* const file = tiff.get();
    const auto stored = std::uint64_t(tiff.file().size());
    const std::uint32_t count = header.tiled ? TIFFNumberOfTiles(file) : TIFFNumberOfStrips(file);
    const std::int64_t height = header.data.height, rows = std::clamp<std::int64_t>(header.rows_per_strip, 1, height);
    const std::int64_t per_plane = (height + rows - 1) / rows;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t begin = TIFFGetStrileOffset(file, i), size = TIFFGetStrileByteCount(file, i);
        std::uint64_t needed = size;
        if (header.compression == COMPRESSION_NONE)
            needed = header.tiled
                         ? TIFFTileSize64(file)
                         : TIFFVStripSize64(file, std::uint32_t(std::min(rows, height - i % per_plane * rows)));
        if (begin > stored || std::max(size, needed) > stored - begin) tiff.fail("is cut short");
        if (size < needed || size == 0) tiff.fail("has too few bytes in strip or tile " + std::to_string(i));
    }
}

} // namespace bake
