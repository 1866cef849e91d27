#include "bake/base/parallel.h"
#include "bake/base/system_lack.h"
#include "bake/picture/exr.h"
#include "bake/picture/exr_frame.h"
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <half.h>
#include <optional>
#include <stdexcept>
#include <utility>

namespace bake {

namespace {

/// Keeps the first failure, as the library ends files in destructors that pass none on.
class OutputStream : public Imf::OStream {
public:
    OutputStream(const std::string& path, const OutputFile& file) : OStream(path.c_str()), file_(file.open_stream()) {}
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
    const char* const format = options.environment == EnvironmentTag::cube      ? exr_cube_format
                               : options.environment == EnvironmentTag::latlong ? exr_latlong_format
                               : options.mips                                   ? "Plain Texture"
                                                                                : nullptr;
    if (format) header.insert("textureformat", Imf::StringAttribute(format));
    if (!options.description.empty()) header.insert("comments", Imf::StringAttribute(options.description));
    if (const std::string record = record_text(options.facts); !record.empty())
        header.insert(record_key, Imf::StringAttribute(record));
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

    [[noreturn]] void fail(const std::string& why) const { refuse_unwritten(path, why); }
    /// Calls into the library, whose exceptions become ours.
    template <class Call> void attempt(Call&& call) {
        try {
            call();
        } catch (const std::exception& error) {
            if (stream.reason().empty() && lacks_memory(error)) throw std::bad_alloc();
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

ExrWriter::ExrWriter(const std::string& path, const OutputFile& file, const PictureSize& size,
                     const WriteOptions& options)
    : impl_(new Impl{path, OutputStream(path, file), options.channels, size.width, options.depth == Depth::half}) {
    impl_->attempt([&] {
        const Imf::Header header = header_for(size, options);
        if (options.mips) impl_->tiles.emplace(impl_->stream, header, exr_helpers());
        else impl_->lines.emplace(impl_->stream, header, exr_helpers());
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
