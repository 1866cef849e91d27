#include "bake/picture/picture_formats.h"
#include "bake/base/error.h"
#include "bake/picture/image_guard.h"
#include "bake/picture/picture_file.h"
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <mutex>

namespace bake {
namespace {

constexpr int band_rows = 256; // a multiple of every compression's block of scanlines

void configure_oiio(int threads) {
    static std::once_flag once;
    std::call_once(once, [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("limits:channels", 64);
        OIIO::attribute("limits:imagesize_MB", 64 * 1024);
    });
    OIIO::attribute("exr_threads", threads > 1 ? threads : 0);
}

// Most samples one stored byte can stand for. A header that claims more is damaged or hostile, and is refused before
// anything is allocated.
double largest_ratio(const OIIO::ImageSpec& spec, const std::string& format) {
    if (format == "dds") return 16; // BC1: 8 bytes per 16 RGBA texels
    // DWA deflates one mean per block of 8 x 8 texels; flat pictures measured 7000.
    if (format == "openexr" && std::string(spec.get_string_attribute("compression")).starts_with("dwa")) return 32768;
    return 4096; // deflate reaches 1032, flat JPEG blocks less
}

SampleType sample_type(OIIO::TypeDesc type) {
    switch (type.basetype) {
    case OIIO::TypeDesc::UINT8: return SampleType::u8;
    case OIIO::TypeDesc::UINT16: return SampleType::u16;
    case OIIO::TypeDesc::UINT32: return SampleType::u32;
    case OIIO::TypeDesc::HALF: return SampleType::half;
    case OIIO::TypeDesc::FLOAT: return SampleType::float32;
    default: return SampleType::other;
    }
}

constexpr const char *cube_format = "CubeFace Environment", *latlong_format = "LatLong Environment";

EnvironmentTag environment_tag(const OIIO::ImageSpec& spec) {
    const auto format = spec.get_string_attribute("textureformat");
    if (format != cube_format && format != latlong_format) return EnvironmentTag::none;
    // Which of the two, the shape says: exrenvmap passes OpenImageIO's own attribute on unchanged beside the new envmap.
    return spec.height == 6 * std::int64_t(spec.width) ? EnvironmentTag::cube : EnvironmentTag::latlong;
}

// The display window, except in cube strips of OpenEXR, whose six faces fill a data window taller than it.
Window picture_window(const OIIO::ImageSpec& spec) {
    const bool cube = environment_tag(spec) == EnvironmentTag::cube;
    if (cube || spec.full_width <= 0 || spec.full_height <= 0) return {spec.x, spec.y, spec.width, spec.height};
    return {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
}

ImageInfo describe(OIIO::ImageInput& in) {
    const OIIO::ImageSpec& spec = in.spec();
    const Window window = picture_window(spec);
    ImageInfo info;
    info.format = in.format_name();
    info.width = window.width;
    info.height = window.height;
    info.channels = spec.channelnames;
    info.channels.resize(spec.nchannels);
    info.type = sample_type(spec.format);
    info.bits = spec.get_int_attribute("oiio:BitsPerSample", 8 * int(spec.format.basesize()));
    info.srgb_tagged = spec.get_string_attribute("oiio:ColorSpace") == "sRGB";
    info.alpha_channel = spec.alpha_channel;
    info.environment = environment_tag(spec);
    info.description = spec.get_string_attribute("ImageDescription");
    return info;
}

std::unique_ptr<OIIO::ImageInput> open_image(const FormatHost& host, const std::string& path, const ReadLimits& limits,
                                             ImageInfo& info) {
    configure_oiio(host.threads);
    const auto stored = std::int64_t(std::filesystem::file_size(path));
    if (const std::string fault = image_fault(path, stored); !fault.empty())
        throw unreadable(path, fault, "export it again, as EXR, TIFF or PNG");

    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // data are not to be multiplied by alpha
    std::unique_ptr<OIIO::ImageInput> in;
    try {
        in = OIIO::ImageInput::open(path, &config);
    } catch (const std::exception& error) { // some decoders pass on what their containers throw
        throw unreadable(path, std::string("its decoder gave up (") + error.what() + ")");
    }
    if (!in) throw unreadable(path, OIIO::geterror(), "give a PNG, EXR, TIFF, JPEG, HDR or other image that is whole");

    info = describe(*in);
    const OIIO::ImageSpec& spec = in->spec();
    const auto unsuitable = [&](const std::string& why) { return Error(Refusal::unsuitable, path + ": " + why); };
    if (spec.depth > 1) throw unsuitable("is a volume; give a flat image");
    if (spec.deep) throw unsuitable("is a deep image; flatten it");
    const std::string sides = spec.get_string_attribute("dds:CubeMapSides"); // "+x -x +y -y +z -z"
    if (!sides.empty() && std::count(sides.begin(), sides.end(), ' ') < 5)
        throw unsuitable("is a cube map of the faces " + sides + " only; give one of all six faces");
    check_size(path, stored,
               {{spec.x, spec.y, spec.width, spec.height},
                picture_window(spec),
                info.channels.empty() ? 0 : spec.nchannels,
                largest_ratio(spec, info.format)},
               limits);
    return in;
}

// A library's warning that some of the picture is missing; other warnings are let pass.
bool says_cut_short(const std::string& message) {
    return message.find("remature") != std::string::npos || message.find("orrupt") != std::string::npos;
}

void read_window(const FormatHost& host, OIIO::ImageInput& in, const std::string& path, Image<float>& image) {
    const OIIO::ImageSpec& spec = in.spec();
    bool whole = true;
    if (spec.tile_width == 0) {
        for (int y = 0; y < spec.height && whole; y += band_rows) {
            if (host.interrupted()) throw Error(Refusal::interrupted, "interrupted");
            const int end = std::min(spec.height, y + band_rows);
            whole = in.read_scanlines(0, 0, spec.y + y, spec.y + end, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT,
                                      image.row(y));
        }
    } else {
        whole = in.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.data());
    }
    const std::string message = in.geterror();
    if (!whole || says_cut_short(message)) throw unreadable(path, message);
}

void read_info(const FormatHost& host, const std::string& path, const ReadLimits& limits, ImageInfo& info) {
    open_image(host, path, limits, info);
}

void read_pixels(const FormatHost& host, const std::string& path, const ReadLimits& limits, ImageInfo& info,
                 Image<float>& image) {
    const auto in = open_image(host, path, limits, info);
    const OIIO::ImageSpec spec = in->spec();
    const Window window = picture_window(spec);
    try {
        image = Image<float>(spec.width, spec.height, spec.nchannels);
        read_window(host, *in, path, image);
        image = place(std::move(image), {spec.x, spec.y, spec.width, spec.height}, window);
    } catch (const std::bad_alloc&) {
        throw Error(Refusal::unsuitable, path + ": needs more memory than there is; scale it down");
    } catch (const std::logic_error& error) { // some decoders pass on what their containers throw
        throw unreadable(path, std::string("its decoder gave up (") + error.what() + ")");
    }
}

OIIO::TypeDesc stored_type(Depth depth) {
    switch (depth) {
    case Depth::u8: return OIIO::TypeDesc::UINT8;
    case Depth::u16: return OIIO::TypeDesc::UINT16;
    case Depth::half: return OIIO::TypeDesc::HALF;
    default: return OIIO::TypeDesc::FLOAT;
    }
}

} // namespace

struct FormatWriter {
    FormatWriter(const std::string& target, const std::string& file, const OIIO::ImageSpec& header, OIIO::TypeDesc rows)
        : path(target), temporary(file), spec(header), type(rows) {}

    std::string path, temporary;
    OIIO::ImageSpec spec;
    OIIO::TypeDesc type; ///< of the rows handed over
    std::unique_ptr<OIIO::ImageOutput> out;
    int next_row = 0;

    [[noreturn]] void fail(const std::string& why) {
        throw Error(Refusal::unwritable,
                    path + ": cannot be written (" + one_line(why, temporary) + "); is the disk full?");
    }
};

namespace {

void open_writer(const FormatHost& host, const std::string& path, const std::string& temporary, const PictureSize& size,
                 const WriteOptions& options, std::shared_ptr<FormatWriter>& writer) {
    configure_oiio(host.threads);
    const OIIO::TypeDesc stored = stored_type(options.depth);
    const bool integers = options.depth == Depth::u8 || options.depth == Depth::u16;
    writer =
        std::make_shared<FormatWriter>(path, temporary, OIIO::ImageSpec(size.width, size.height, size.channels, stored),
                                       integers ? stored : OIIO::TypeDesc::FLOAT);
    writer->out = OIIO::ImageOutput::create(path);
    if (!writer->out) writer->fail(OIIO::geterror());

    OIIO::ImageSpec& spec = writer->spec;
    spec.channelnames = options.channels;
    spec.alpha_channel = -1;
    for (int c = 0; c < size.channels; ++c)
        if (spec.channelnames[c] == "A") spec.alpha_channel = c;
    const std::string format = writer->out->format_name();
    const bool zip =
        options.compression == Compression::automatic ? format == "openexr" : options.compression == Compression::zip;
    if (format != "png") spec.attribute("compression", zip ? "zip" : "none");
    if (format == "png" && options.srgb) spec.attribute("oiio:ColorSpace", "sRGB");
    if (format == "png") spec.attribute("png:compressionLevel", 3); // level 6 costs 3 times as long for 2 % of the size
    spec.attribute("oiio:UnassociatedAlpha", 1);
    // OIIO writes the time of day unless told another one: the same picture is the same bytes tomorrow.
    if (format != "png") spec.attribute("DateTime", "1970:01:01 00:00:00");
    if (!options.description.empty()) spec.attribute("ImageDescription", options.description);
    if (options.environment == EnvironmentTag::cube) {
        spec.attribute("textureformat", cube_format);
        spec.full_height = spec.full_width;
    }
    if (options.environment == EnvironmentTag::latlong) spec.attribute("textureformat", latlong_format);
    if (options.mips) {
        if (!writer->out->supports("mipmap") && !writer->out->supports("multiimage"))
            throw Error(Refusal::usage, path + ": PNG has no mips; write .exr or .tif");
        spec.tile_width = spec.tile_height = 64;
        if (options.environment == EnvironmentTag::none) spec.attribute("textureformat", "Plain Texture");
    }
    if (!writer->out->open(temporary, spec)) writer->fail(writer->out->geterror());
}

// TIFF stores tiles whole, and OIIO leaves what lies beyond the picture's edge as the memory was.
bool write_whole_tiles(FormatWriter& writer, const char* values, int rows) {
    const OIIO::ImageSpec& spec = writer.spec;
    const std::size_t texel = writer.type.size() * spec.nchannels, row_size = texel * spec.width,
                      tile_row = texel * spec.tile_width;
    std::vector<char> tile(tile_row * spec.tile_height);
    for (int y = 0; y < rows; y += spec.tile_height)
        for (int x = 0; x < spec.width; x += spec.tile_width) {
            std::fill(tile.begin(), tile.end(), '\0');
            const std::size_t covered = texel * std::min(spec.tile_width, spec.width - x);
            for (int j = 0; j < std::min(spec.tile_height, rows - y); ++j)
                std::memcpy(tile.data() + j * tile_row, values + (y + j) * row_size + x * texel, covered);
            if (!writer.out->write_tile(x, writer.next_row + y, 0, writer.type, tile.data())) return false;
        }
    return true;
}

void write_rows(FormatWriter& writer, const void* values, int rows) {
    OIIO::ImageOutput& out = *writer.out;
    const int first = writer.next_row, end = first + rows;
    const bool written = !writer.spec.tile_width ? out.write_scanlines(first, end, 0, writer.type, values)
                         : out.supports("mipmap")
                             ? out.write_tiles(0, writer.spec.width, first, end, 0, 1, writer.type, values)
                             : write_whole_tiles(writer, static_cast<const char*>(values), rows);
    if (!written) writer.fail(out.geterror());
    writer.next_row = end;
}

void next_level(FormatWriter& writer) {
    OIIO::ImageSpec& spec = writer.spec;
    spec.width = spec.full_width = std::max(1, spec.width / 2);
    spec.height = spec.full_height = std::max(1, spec.height / 2);
    if (spec.get_string_attribute("textureformat") == cube_format) spec.full_height = spec.full_width;
    writer.next_row = 0;
    // In TIFF the levels are images of their own, which OIIO reads back as levels.
    const auto mode =
        writer.out->supports("mipmap") ? OIIO::ImageOutput::AppendMIPLevel : OIIO::ImageOutput::AppendSubimage;
    if (!writer.out->open(writer.temporary, spec, mode)) writer.fail(writer.out->geterror());
}

void finish(FormatWriter& writer) {
    if (!writer.out->close()) writer.fail(writer.out->geterror());
    writer.out.reset(); // close() leaves EXR files with mips open
    const auto stored = std::int64_t(std::filesystem::file_size(writer.temporary));
    if (!image_fault(writer.temporary, stored).empty()) writer.fail("is cut short");
}

/// The same function with its exceptions as values.
template <auto Function> struct Returned;
template <class... Arguments, void (*Function)(Arguments...)> struct Returned<Function> {
    static FormatResult call(Arguments... arguments) try {
        Function(arguments...);
        return {};
    } catch (const Error& error) {
        return FormatFailure{error.refusal, error.what()};
    } catch (const std::exception& error) {
        return FormatFailure{Refusal::unsuitable, std::string("the picture cannot be handled (") + error.what() + ")"};
    }
};

} // namespace
} // namespace bake

extern "C" const bake::PictureFormats* bake_picture_formats() {
    using namespace bake;
    static const PictureFormats formats{Returned<read_info>::call,   Returned<read_pixels>::call,
                                        Returned<open_writer>::call, Returned<write_rows>::call,
                                        Returned<next_level>::call,  Returned<finish>::call};
    return &formats;
}
