#include "bake/picture/exr.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/picture/exr_guard.h"
#include "bake/picture/exr_layers.h"
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace bake {
namespace {

constexpr int band_rows = 256; // a multiple of every compression's block of scan lines
constexpr const char *cube_format = "CubeFace Environment", *latlong_format = "LatLong Environment";

/// Threads of OpenEXR's own that help the one that calls it.
int helpers() {
    static std::mutex once_at_a_time;
    const std::lock_guard lock(once_at_a_time);
    const int wanted = thread_count() > 1 ? thread_count() : 0;
    if (Imf::globalThreadCount() != wanted) Imf::setGlobalThreadCount(wanted);
    return wanted;
}

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
    if (!Imf::hasEnvmap(header) && format != cube_format && format != latlong_format) return EnvironmentTag::none;
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
    info.srgb_tagged = text_attribute(header, "oiio:ColorSpace") == "sRGB";
    if (info.srgb_tagged) info.colour = {.source = "oiio:ColorSpace attribute", .curves = {srgb_curve()}};
    info.colour.note = primaries_note(header);
    if (!choice.left_out.empty()) info.notes.push_back(left_out(choice));
    return info;
}

/// Slices of interleaved samples, of which `first` is the one at the window's upper left corner.
template <class Sample>
Imf::FrameBuffer frame_of(const Sample* first, const std::vector<std::string>& channels, int x, int y, int width) {
    const std::size_t step = channels.size() * sizeof(Sample), row = step * std::size_t(width);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        // The library adds the coordinates back; as numbers, for the origin may lie outside the memory.
        const auto origin = reinterpret_cast<std::uintptr_t>(first + c) -
                            std::uintptr_t(std::int64_t(x) * std::int64_t(step) + std::int64_t(y) * std::int64_t(row));
        frame.insert(channels[c], Imf::Slice(sizeof(Sample) == 2 ? Imf::HALF : Imf::FLOAT,
                                             reinterpret_cast<char*>(origin), step, row));
    }
    return frame;
}

} // namespace

bool is_exr(const PictureFile& file) noexcept { return file.head().starts_with("\x76\x2f\x31\x01"); }

namespace {

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
    Imf::MultiPartInputFile in(stream, helpers());
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
    Imf::InputFile in(stream, helpers());
    return read_part(in, file, limits, info, image);
} catch (const Error&) {
    throw;
} catch (const std::bad_alloc&) {
    throw Error(Refusal::unsuitable, file.path() + ": needs more memory than there is; scale it down");
} catch (const std::exception& error) {
    throw unreadable(file.path(), error.what());
}

namespace {

/// Keeps the first failure, as the library ends files in destructors that pass none on.
class OutputStream : public Imf::OStream {
public:
    explicit OutputStream(const std::string& temporary)
        // The file is there and empty: one that is opened anew as empty is written to the disk by ext4 before it is closed.
        : OStream(temporary.c_str()), file_(std::fopen(temporary.c_str(), "r+b")) {
        if (!file_) keep_reason();
    }
    ~OutputStream() override { close(); }

    void write(const char bytes[], int size) override {
        if (file_ && std::fwrite(bytes, 1, std::size_t(size), file_) == std::size_t(size)) return;
        keep_reason();
        throw std::runtime_error(reason_);
    }
    std::uint64_t tellp() override { return std::uint64_t(ftello(file_)); }
    void seekp(std::uint64_t at) override {
        if (fseeko(file_, off_t(at), SEEK_SET) != 0) keep_reason();
    }
    void close() {
        if (file_ && std::fclose(std::exchange(file_, nullptr)) != 0) keep_reason();
    }
    const std::string& reason() const noexcept { return reason_; }

private:
    void keep_reason() {
        if (reason_.empty()) reason_ = std::strerror(errno);
    }

    std::FILE* file_;
    std::string reason_;
};

Imf::Header header_for(const PictureSize& size, const WriteOptions& options) {
    const Imath::Box2i data({0, 0}, {size.width - 1, size.height - 1});
    const bool cube = options.environment == EnvironmentTag::cube;
    Imf::Header header(cube ? Imath::Box2i({0, 0}, {size.width - 1, size.width - 1}) : data, data);
    header.compression() = options.compression == Compression::none ? Imf::NO_COMPRESSION : Imf::ZIP_COMPRESSION;
    for (const std::string& name : options.channels)
        header.channels().insert(name, Imf::Channel(options.depth == Depth::half ? Imf::HALF : Imf::FLOAT));
    if (options.environment != EnvironmentTag::none)
        Imf::addEnvmap(header, cube ? Imf::ENVMAP_CUBE : Imf::ENVMAP_LATLONG);
    // What OpenImageIO's texture system looks at.
    const char* const format = options.environment == EnvironmentTag::cube      ? cube_format
                               : options.environment == EnvironmentTag::latlong ? latlong_format
                               : options.mips                                   ? "Plain Texture"
                                                                                : nullptr;
    if (format) header.insert("textureformat", Imf::StringAttribute(format));
    if (!options.description.empty()) header.insert("comments", Imf::StringAttribute(options.description));
    if (options.mips) header.setTileDescription({64, 64, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN});
    return header;
}

} // namespace

struct ExrWriter::Impl {
    std::string path;
    OutputStream stream;
    std::vector<std::string> channels;
    int width;
    bool half;
    std::optional<Imf::OutputFile> lines = {};
    std::optional<Imf::TiledOutputFile> tiles = {};
    int level = 0, row = 0;
    std::vector<Imath::half> halves = {};

    [[noreturn]] void fail(const std::string& why) const {
        throw Error(Refusal::unwritable, path + ": cannot be written (" + why + "); is the disk full?");
    }
    /// Calls into the library, whose exceptions become ours.
    template <class Call> void attempt(Call&& call) {
        try {
            call();
        } catch (const std::exception& error) {
            fail(stream.reason().empty() ? one_line(error.what(), path) : stream.reason());
        }
    }
    void write(const Imf::FrameBuffer& frame, int rows) {
        if (lines) {
            lines->setFrameBuffer(frame);
            lines->writePixels(rows);
            return;
        }
        const int size = int(tiles->tileYSize()), first = row / size;
        tiles->setFrameBuffer(frame);
        tiles->writeTiles(0, tiles->numXTiles(level) - 1, first, first + (rows + size - 1) / size - 1, level);
    }
};

ExrWriter::ExrWriter(const std::string& path, const std::string& temporary, const PictureSize& size,
                     const WriteOptions& options)
    : impl_(new Impl{path, OutputStream(temporary), options.channels, size.width, options.depth == Depth::half}) {
    if (!impl_->stream.reason().empty()) impl_->fail(impl_->stream.reason());
    impl_->attempt([&] {
        const Imf::Header header = header_for(size, options);
        if (options.mips) impl_->tiles.emplace(impl_->stream, header, helpers());
        else impl_->lines.emplace(impl_->stream, header, helpers());
    });
}

ExrWriter::~ExrWriter() = default;

void ExrWriter::write(const float* values, int rows) {
    const std::size_t row_size = std::size_t(impl_->width) * impl_->channels.size();
    if (impl_->half) {
        impl_->halves.resize(row_size * std::size_t(rows));
        for_rows(rows, 64, [&](std::int64_t begin, std::int64_t end) {
            for (std::size_t i = std::size_t(begin) * row_size; i < std::size_t(end) * row_size; ++i)
                impl_->halves[i] = Imath::half(values[i]);
        });
    }
    impl_->attempt([&] {
        const int row = impl_->row, width = impl_->width;
        impl_->write(impl_->half ? frame_of(impl_->halves.data(), impl_->channels, 0, row, width)
                                 : frame_of(values, impl_->channels, 0, row, width),
                     rows);
    });
    impl_->row += rows;
}

void ExrWriter::next_level() {
    impl_->width = std::max(1, impl_->width / 2);
    ++impl_->level, impl_->row = 0;
}

void ExrWriter::finish() {
    impl_->lines.reset(), impl_->tiles.reset(); // writes the table of offsets
    impl_->stream.close();
    if (!impl_->stream.reason().empty()) impl_->fail(impl_->stream.reason());
}

} // namespace bake
