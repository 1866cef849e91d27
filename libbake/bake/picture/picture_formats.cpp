#include "bake/picture/picture_formats.h"
#include "bake/picture/decoder_limits.h"
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string_view>
#include <vector>

namespace bake {
namespace {

/// The file for decoders, should one of them open it by its name.
constexpr const char* opened_name = "/proc/self/fd/3";

void configure_oiio() {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1); // none beside this one
    OIIO::attribute("limits:channels", 64);
    OIIO::attribute("limits:imagesize_MB", 64 * 1024);
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
    const bool indices = info.format == "targa" || info.format == "bmp";
    info.bits = indices ? stored : spec.get_int_attribute("oiio:BitsPerSample", stored);
    // For DDS the attribute has the bits of a texel.
    if (info.format == "dds" || info.bits < 1 || info.bits > 64) info.bits = stored;
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

/// Goes to the first picture of full size: a file may hold smaller ones, and animations hold further ones. The first picture
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

/// A decoder's words as an error, without its name of the file.
Error said(const PictureFile& file, const std::string& message) {
    return unreadable(file.path(), one_line(message, opened_name), "export it again, as EXR, TIFF or PNG");
}

std::unique_ptr<OIIO::ImageInput> open_image(const PictureFile& file, const OpenFile& open, const std::string& format) {
    auto in = OIIO::ImageInput::create(format);
    if (!in || !open.proxy || !in->supports("ioproxy") || !in->set_ioproxy(open.proxy.get()))
        throw decoder_failed(file.path(), "cannot read the open file");
    OIIO::ImageSpec spec, config;
    config.attribute("oiio:UnassociatedAlpha", 1); // data are not to be multiplied by alpha
    const bool opened = in->open(opened_name, spec, config);
    // Decoders of progressive pictures read them whole in opening them.
    if (const std::string message = in->geterror(); !opened || says_cut_short(message)) throw said(file, message);
    return in;
}

SampleType sent_type(const OIIO::ImageSpec& spec) {
    if (!spec.channelformats.empty()) return SampleType::float32;
    return spec.format == OIIO::TypeDesc::UINT8    ? SampleType::u8
           : spec.format == OIIO::TypeDesc::UINT16 ? SampleType::u16
                                                   : SampleType::float32;
}

/// Describes the picture and checks its size. Throws for what is no flat picture.
ReplyHeader read_header(OIIO::ImageInput& in, const PictureFile& file, const ReadLimits& limits) {
    const std::string others = choose_subimage(in);
    const OIIO::ImageSpec& spec = in.spec();
    ReplyHeader header{.info = describe(in, file),
                       .data = {spec.x, spec.y, spec.width, spec.height},
                       .picture = picture_window(spec),
                       .sent = sent_type(spec)};
    if (!others.empty()) header.info.notes.push_back(others);
    const auto unsuitable = [&](const std::string& why) {
        return Error(Refusal::unsuitable, file.path() + ": " + why);
    };
    if (spec.depth > 1) throw unsuitable("is a volume; give a flat image");
    if (spec.deep) throw unsuitable("is a deep image; flatten it");
    check_size(file.path(), file.size(),
               {header.data, header.picture, header.info.channels.empty() ? 0 : spec.nchannels,
                largest_ratio(spec, header.info.format)},
               limits);
    // Others turn their pictures themselves.
    if (header.info.format == "jpeg" || header.info.format == "webp")
        header.orientation = std::clamp(spec.get_int_attribute("Orientation", 1), 0, 9);
    if (const auto* icc = spec.find_attribute("ICCProfile"); icc && icc->data())
        header.icc.assign(static_cast<const char*>(icc->data()), icc->type().size());
    return header;
}

/// Sends all rows, in bands.
void send_texels(OIIO::ImageInput& in, const PictureFile& file, SampleType sent, ReplyStream& reply) {
    const OIIO::ImageSpec spec = in.spec();
    const OIIO::TypeDesc type = sent == SampleType::u8    ? OIIO::TypeDesc::UINT8
                                : sent == SampleType::u16 ? OIIO::TypeDesc::UINT16
                                                          : OIIO::TypeDesc::FLOAT;
    const std::int64_t row_bytes = std::int64_t(spec.width) * spec.nchannels * std::int64_t(sent_bytes(sent));
    // All rows at once from tiles, else whole blocks of scanlines of every compression.
    constexpr std::int64_t most_rows = 256, most_bytes = 64 << 20;
    const bool tiled = spec.tile_width != 0;
    const auto band = int(std::clamp(most_bytes / row_bytes, std::int64_t(1), most_rows));
    std::vector<char> rows(std::size_t(row_bytes * (tiled ? spec.height : std::min(band, spec.height))));
    bool whole = !tiled || in.read_image(0, 0, 0, spec.nchannels, type, rows.data());
    for (int y = 0; y < spec.height && whole; y += band) {
        const int end = std::min(spec.height, y + band);
        if (!tiled) whole = in.read_scanlines(0, 0, spec.y + y, spec.y + end, 0, 0, spec.nchannels, type, rows.data());
        if (whole)
            reply.send(ReplyFrame::texels, rows.data() + (tiled ? y * row_bytes : 0),
                       std::size_t((end - y) * row_bytes));
    }
    if (const std::string message = in.geterror(); !whole || says_cut_short(message)) throw said(file, message);
}

} // namespace

void decode(const PictureFile& file, const DecodeRequest& request, ReplyStream& reply) {
    configure_oiio();
    const OpenFile open(file);
    const auto in = open_image(file, open, request.format);
    const ReplyHeader header = read_header(*in, file, request.limits);
    const double samples = double(header.data.width) * header.data.height * double(header.info.channels.size());
    limit_decoder(decoder_limits(file.size(), std::max(samples, request.samples)), request.largest, request.libraries);
    reply.send(ReplyFrame::header, to_bytes(header));
    if (request.texels) send_texels(*in, file, header.sent, reply);
    reply.send(ReplyFrame::end);
}

} // namespace bake
