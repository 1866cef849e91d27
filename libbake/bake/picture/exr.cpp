#include "bake/picture/exr.h"
#include "bake/base/progress.h"
#include "bake/base/system_lack.h"
#include "bake/picture/exr_frame.h"
#include "bake/picture/exr_guard.h"
#include "bake/picture/exr_layers.h"
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace bake {
namespace {

constexpr int band_rows = 256; // a multiple of every compression's block of scan lines

class InputStream : public Imf::IStream {
public:
    explicit InputStream(const PictureFile& file) : IStream(file.path().c_str()), file_(file) {}
    bool read(char to[], int size) override {
        if (file_.read(at_, to, size) != size) throw std::runtime_error("is cut short");
        at_ += size;
        return at_ < file_.size();
    }
    std::uint64_t tellg() override { return std::uint64_t(at_); }
    void seekg(std::uint64_t at) override { at_ = std::int64_t(at); }
    void clear() override {}

private:
    const PictureFile& file_;
    std::int64_t at_ = 0;
};

std::vector<std::string> names_of(const Imf::ChannelList& channels) {
    std::vector<std::string> names;
    for (auto c = channels.begin(); c != channels.end(); ++c) names.emplace_back(c.name());
    return names;
}

/// Whether the library gives these channels as floats without more ado.
bool are_plain(const Imf::ChannelList& channels, const std::vector<std::string>& names) {
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        const Imf::Channel& channel = channels[name];
        return channel.xSampling == 1 && channel.ySampling == 1 && channel.type != Imf::UINT;
    });
}

std::string text_attribute(const Imf::Header& header, const char* name) {
    const auto* const text = header.findTypedAttribute<Imf::StringAttribute>(name);
    return text ? text->value() : "";
}

Window window_of(const Imath::Box2i& box) {
    // In 64 bits: the corners of a hostile header are far apart.
    const auto size = [](std::int64_t low, std::int64_t high) {
        return int(std::clamp<std::int64_t>(high - low + 1, 0, 1 << 30));
    };
    return {box.min.x, box.min.y, size(box.min.x, box.max.x), size(box.min.y, box.max.y)};
}

EnvironmentTag environment_tag(const Imf::Header& header, const Window& data) {
    const std::string format = text_attribute(header, "textureformat");
    if (!Imf::hasEnvmap(header) && format != exr_cube_format && format != exr_latlong_format)
        return EnvironmentTag::none;
    // The shape tells which of the two: exrenvmap passes the attribute of its input on unchanged.
    return data.height == 6 * std::int64_t(data.width) ? EnvironmentTag::cube : EnvironmentTag::latlong;
}

/// What is said and left out: channels of other layers.
std::string left_out(const LayerChoice& choice) {
    constexpr std::size_t most = 6;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, choice.left_out.size()); ++i)
        text += (i > 0 ? ", " : "") + choice.left_out[i];
    if (choice.left_out.size() > most) text += " and " + std::to_string(choice.left_out.size() - most) + " more";
    std::string read;
    for (const std::string& name : choice.channels) read += (read.empty() ? "" : ", ") + name;
    return "has further channels beside " + read + ", which are left out: " + text;
}

std::string primaries_note(const Imf::Header& header) {
    if (!Imf::hasChromaticities(header)) return {};
    const Imf::Chromaticities given = Imf::chromaticities(header), srgb;
    const auto near = [](const Imath::V2f& a, const Imath::V2f& b) { return (a - b).length() < 0.01f; };
    if (near(given.red, srgb.red) && near(given.green, srgb.green) && near(given.blue, srgb.blue)) return {};
    return "has other primaries than sRGB: its colours are not converted";
}

ImageInfo describe(const Imf::Header& header, const LayerChoice& choice, const Window& data) {
    ImageInfo info;
    info.format = "openexr";
    info.environment = environment_tag(header, data);
    // The six faces of a cube strip fill a data window taller than the display window.
    const Window picture = info.environment == EnvironmentTag::cube ? data : window_of(header.displayWindow());
    info.width = picture.width, info.height = picture.height;
    info.type = SampleType::half;
    info.channels = choice.names, info.colours = choice.colours;
    for (std::size_t c = 0; c < choice.channels.size(); ++c) {
        if (header.channels()[choice.channels[c]].type == Imf::FLOAT) info.type = SampleType::float32;
        if (info.alpha_channel < 0 && is_alpha(choice.names[c])) info.alpha_channel = int(c);
    }
    info.bits = info.type == SampleType::half ? 16 : 32;
    info.description = text_attribute(header, "comments");
    info.record = valid_record(text_attribute(header, record_key));
    info.srgb_tagged = text_attribute(header, "oiio:ColorSpace") == "sRGB";
    if (info.srgb_tagged) info.colour = {.source = "oiio:ColorSpace attribute", .curves = {srgb_curve()}};
    info.colour.note = primaries_note(header);
    if (!choice.left_out.empty()) info.notes.push_back(left_out(choice));
    return info;
}

/// One picture of an open file, which is the file itself or a part of it. As read_exr.
template <class Input>
bool read_part(Input& in, const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    const Imf::Header& header = in.header();
    const Window data = window_of(header.dataWindow());
    const LayerChoice choice = choose_layer(names_of(header.channels()));
    if (choice.channels.empty() || !are_plain(header.channels(), choice.channels)) return false;
    info = describe(header, choice, data);
    const Window shown = window_of(header.displayWindow());
    const Window picture = info.environment == EnvironmentTag::cube ? data : shown;
    // DWA deflates one mean per block of 8 x 8 texels; flat pictures measured 7000.
    const bool dwa = header.compression() == Imf::DWAA_COMPRESSION || header.compression() == Imf::DWAB_COMPRESSION;
    const int channels = int(choice.channels.size());
    check_size(file.path(), file.size(), {data, picture, channels, dwa ? 32768.0 : 4096.0}, limits);
    if (!image) return true;
    Image<float> stored(data.width, data.height, channels);
    in.setFrameBuffer(frame_of(stored.data(), choice.channels, data.x, data.y, data.width));
    for (int y = 0; y < data.height; y += band_rows) {
        throw_if_interrupted();
        in.readPixels(data.y + y, data.y + std::min(data.height, y + band_rows) - 1);
    }
    *image = place(std::move(stored), data, picture);
    return true;
}

double area_of(const Imf::Header& header) {
    const Window window = window_of(header.displayWindow());
    return double(window.width) * window.height;
}

/// The first part of full size that is the picture by its name, or else that has colours or a grey; -1 without any.
int choose_part(const Imf::MultiPartInputFile& in) {
    const auto is_flat = [&](int part) {
        return !in.header(part).hasType() || !Imf::isDeepData(in.header(part).type());
    };
    double largest = 0;
    for (int part = 0; part < in.parts(); ++part)
        if (is_flat(part)) largest = std::max(largest, area_of(in.header(part)));
    int chosen = -1, best = -1;
    for (int part = 0; part < in.parts(); ++part) {
        const Imf::Header& header = in.header(part);
        if (!is_flat(part) || area_of(header) < largest / 2) continue;
        const int score = (choose_layer(names_of(header.channels())).colours > 0 ? 1 : 0) +
                          (header.hasName() && is_main_layer(header.name()) ? 2 : 0);
        if (score > best) chosen = part, best = score;
    }
    return chosen;
}

bool read_parts(const PictureFile& file, InputStream& stream, const ReadLimits& limits, ImageInfo& info,
                Image<float>* image) {
    Imf::MultiPartInputFile in(stream, exr_helpers());
    const int chosen = choose_part(in);
    if (chosen < 0) return false;
    Imf::InputPart part(in, chosen);
    if (!read_part(part, file, limits, info, image)) return false;
    if (in.parts() < 2) return true;
    const std::string name = part.header().hasName() ? " (\"" + part.header().name() + "\")" : "";
    info.notes.push_back("has " + std::to_string(in.parts()) + " parts: number " + std::to_string(chosen + 1) + name +
                         " is read, the others are left out");
    return true;
}

} // namespace

bool read_exr(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) try {
    if (const std::string fault = exr_fault(file); !fault.empty())
        throw unreadable(file.path(), fault, "export it again, as EXR, TIFF or PNG");
    // Version 2, and no flag but those for tiles, long names, deep parts and several parts.
    const std::string& head = file.head();
    constexpr int tiles_and_names = 0x6, deep = 0x8, many = 0x10;
    if (head[4] != 2 || (head[5] & ~(tiles_and_names | deep | many)) || head[6] || head[7]) return false;
    InputStream stream(file);
    if (head[5] & many) return read_parts(file, stream, limits, info, image);
    if (head[5] & deep) return false;
    Imf::InputFile in(stream, exr_helpers());
    return read_part(in, file, limits, info, image);
} catch (const Error&) {
    throw;
} catch (const std::exception& error) {
    if (lacks_memory(error)) throw out_of_memory(file.path());
    throw unreadable(file.path(), error.what());
}

} // namespace bake
