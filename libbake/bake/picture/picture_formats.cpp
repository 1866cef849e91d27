#include "bake/picture/picture_formats.h"
#include "bake/picture/image_guard.h"
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <string_view>

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
    case OIIO::TypeDesc::INT8: return SampleType::i8;
    case OIIO::TypeDesc::INT16: return SampleType::i16;
    case OIIO::TypeDesc::INT32: return SampleType::i32;
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

/// Whether the values come from a palette. OpenImageIO gives its colours and does not tell.
bool has_palette(const std::string& format, const std::string& head) {
    const auto byte = [&](std::size_t at) { return at < head.size() ? static_cast<unsigned char>(head[at]) : 0; };
    if (format == "gif") return true;
    if (format == "targa") return byte(1) == 1 && (byte(2) == 1 || byte(2) == 9);
    if (format != "bmp" || byte(28) > 8) return false;
    // Most grey pictures have a palette that is a ramp, as the format knows no other grey.
    const std::size_t palette = 14 + std::size_t(byte(14)), steps = (std::size_t(1) << byte(28)) - 1;
    for (std::size_t i = 0; i <= steps && palette + 4 * i + 2 < head.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            if (std::size_t(byte(palette + 4 * i + c)) != 255 * i / steps) return true;
    return false;
}

ImageInfo describe(OIIO::ImageInput& in, const PictureFile& file) {
    const OIIO::ImageSpec& spec = in.spec();
    const Window window = picture_window(spec);
    ImageInfo info;
    info.format = in.format_name();
    info.width = window.width;
    info.height = window.height;
    info.channels = spec.channelnames;
    info.channels.resize(spec.nchannels);
    info.type = sample_type(spec.format);
    info.palette = has_palette(info.format, file.head());
    // For Targa and BMP that attribute counts the bits of an index.
    const int stored = 8 * int(spec.format.basesize());
    const bool indices = info.format == "targa" || info.format == "bmp" || info.format == "gif";
    info.bits = indices ? stored : spec.get_int_attribute("oiio:BitsPerSample", stored);
    // For DDS the attribute has the bits of a texel. Channels of more than 8 bits are not read here.
    if (info.format == "dds") info.bits = stored;
    info.srgb_tagged = spec.get_string_attribute("oiio:ColorSpace") == "sRGB";
    info.alpha_channel = spec.alpha_channel;
    const int before_alpha = info.alpha_channel >= 0 ? info.alpha_channel : spec.nchannels;
    info.colours = before_alpha >= 3 ? 3 : before_alpha == 1 ? 1 : 0;
    info.environment = environment_tag(spec);
    info.description = spec.get_string_attribute("ImageDescription");
    return info;
}

/// The open file for OpenImageIO, which may close its own copy.
struct OpenFile {
    explicit OpenFile(const PictureFile& file) {
        const int copy = file.duplicate();
        stream = copy < 0 ? nullptr : fdopen(copy, "rb");
        if (!stream) return;
        std::rewind(stream);
        proxy = std::make_unique<OIIO::Filesystem::IOFile>(stream, OIIO::Filesystem::IOProxy::Read);
    }
    ~OpenFile() {
        proxy.reset();
        if (stream) std::fclose(stream);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    std::FILE* stream = nullptr;
    std::unique_ptr<OIIO::Filesystem::IOProxy> proxy;
};

/// Goes to the first picture of full size: files of icons hold smaller ones, animations further ones. The first picture
/// of a Photoshop file is the composite of the others.
std::string choose_subimage(OIIO::ImageInput& in) {
    constexpr int most = 64;
    if (std::string_view(in.format_name()) == "psd") return {};
    double largest = 0;
    int chosen = 0, count = 0;
    for (; count < most && in.seek_subimage(count, 0); ++count) {
        const double area = double(in.spec().width) * in.spec().height;
        if (area > largest) largest = area, chosen = count;
    }
    in.geterror(); // of the search for one more
    if (count < 2) {
        in.seek_subimage(0, 0);
        return {};
    }
    if (!in.seek_subimage(chosen, 0)) return {};
    return "has " + std::to_string(count) + (count == most ? " or more" : "") + " pictures (subimages): number " +
           std::to_string(chosen + 1) + " is read, the others are left out";
}

// A library's warning that some of the picture is missing; other warnings are let pass.
bool says_cut_short(const std::string& message) {
    return message.find("remature") != std::string::npos || message.find("orrupt") != std::string::npos;
}

/// The open file through the decoder that its ending names; null when that does not take it.
std::unique_ptr<OIIO::ImageInput> open_by_ending(const std::string& path, const OpenFile& open,
                                                 const OIIO::ImageSpec& config) {
    const std::size_t dot = path.rfind('.');
    if (dot == std::string::npos || path.find('/', dot) != std::string::npos || !open.proxy) return nullptr;
    auto in = OIIO::ImageInput::create(path.substr(dot + 1));
    if (!in || !in->supports("ioproxy")) return nullptr;
    in->set_ioproxy(open.proxy.get());
    OIIO::ImageSpec spec;
    if (!in->open(path, spec, config)) return nullptr;
    return in;
}

std::unique_ptr<OIIO::ImageInput> open_image(const FormatHost& host, const PictureFile& file, const OpenFile& open,
                                             const ReadLimits& limits, FormatPicture& picture) {
    configure_oiio(host.threads);
    const std::string& path = file.path();
    if (const std::string fault = image_fault(file); !fault.empty())
        throw unreadable(path, fault, "export it again, as EXR, TIFF or PNG");

    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // data are not to be multiplied by alpha
    std::unique_ptr<OIIO::ImageInput> in;
    try {
        in = open_by_ending(path, open, config);
        // Names may be wrong, and some decoders insist on opening the file themselves.
        if (!in) OIIO::geterror(), in = OIIO::ImageInput::open(path, &config);
    } catch (const std::exception& error) { // some decoders pass on what their containers throw
        throw unreadable(path, std::string("its decoder gave up (") + error.what() + ")");
    }
    if (!in) throw unreadable(path, OIIO::geterror(), "give a PNG, EXR, TIFF, JPEG, HDR or other image that is whole");

    // Decoders of progressive pictures read them whole in opening them.
    if (const std::string said = in->geterror(); says_cut_short(said)) throw unreadable(path, said);
    const std::string others = choose_subimage(*in);
    ImageInfo& info = picture.info = describe(*in, file);
    if (!others.empty()) info.notes.push_back(others);
    const OIIO::ImageSpec& spec = in->spec();
    const auto unsuitable = [&](const std::string& why) { return Error(Refusal::unsuitable, path + ": " + why); };
    if (spec.depth > 1) throw unsuitable("is a volume; give a flat image");
    if (spec.deep) throw unsuitable("is a deep image; flatten it");
    const std::string sides = spec.get_string_attribute("dds:CubeMapSides"); // "+x -x +y -y +z -z"
    if (!sides.empty() && std::count(sides.begin(), sides.end(), ' ') < 5)
        throw unsuitable("is a cube map of the faces " + sides + " only; give one of all six faces");
    check_size(path, file.size(),
               {{spec.x, spec.y, spec.width, spec.height},
                picture_window(spec),
                info.channels.empty() ? 0 : spec.nchannels,
                largest_ratio(spec, info.format)},
               limits);
    // Others turn their pictures themselves.
    if (info.format == "jpeg" || info.format == "webp") picture.orientation = spec.get_int_attribute("Orientation", 1);
    if (const auto* icc = spec.find_attribute("ICCProfile"); icc && icc->data())
        picture.icc.assign(static_cast<const char*>(icc->data()), icc->type().size());
    return in;
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

void read_picture(const FormatHost& host, const PictureFile& file, const ReadLimits& limits, bool texels,
                  FormatPicture& picture) {
    const OpenFile open(file);
    const auto in = open_image(host, file, open, limits, picture);
    if (!texels) return;
    const OIIO::ImageSpec spec = in->spec();
    try {
        picture.image = Image<float>(spec.width, spec.height, spec.nchannels);
        read_window(host, *in, file.path(), picture.image);
        picture.image =
            place(std::move(picture.image), {spec.x, spec.y, spec.width, spec.height}, picture_window(spec));
    } catch (const std::bad_alloc&) {
        throw Error(Refusal::unsuitable, file.path() + ": needs more memory than there is; scale it down");
    } catch (const std::logic_error& error) { // some decoders pass on what their containers throw
        throw unreadable(file.path(), std::string("its decoder gave up (") + error.what() + ")");
    }
}

FormatResult read(const FormatHost& host, const PictureFile& file, const ReadLimits& limits, bool texels,
                  FormatPicture& picture) try {
    read_picture(host, file, limits, texels, picture);
    return {};
} catch (const Error& error) {
    return FormatFailure{error.refusal, error.what()};
} catch (const std::exception& error) {
    return FormatFailure{Refusal::unsuitable, std::string("the picture cannot be handled (") + error.what() + ")"};
}

} // namespace
} // namespace bake

extern "C" const bake::PictureFormats* bake_picture_formats() {
    static const bake::PictureFormats formats{bake::read};
    return &formats;
}
