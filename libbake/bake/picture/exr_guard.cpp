#include "bake/picture/exr_guard.h"
#include <algorithm>
#include <utility>

namespace bake {
namespace {

/// A number of 4 bytes, 0 beyond the end.
std::uint32_t u32(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (int i = 0; at + 4 <= bytes.size() && i < 4; ++i)
        value |= std::uint32_t(static_cast<unsigned char>(bytes[at + std::size_t(i)])) << 8 * i;
    return value;
}

/// The attributes of one part of an OpenEXR file that its pixels depend on.
struct ExrPart {
    bool channels = false, compression = false, data_window = false, display_window = false;
    int method = 0;
    double width = 0, height = 0, tile_width = 0, tile_height = 0;

    /// Scan lines or tiles of the finest level, each of which has at least an offset of 8 bytes and a header of 8.
    double chunks() const {
        const auto parts = [](double n, double size) { return double(std::int64_t((n + size - 1) / size)); };
        if (tile_width > 0 && tile_height > 0) return parts(width, tile_width) * parts(height, tile_height);
        constexpr int lines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
        return parts(height, lines[std::clamp(method, 0, 9)]);
    }
};

/// The bytes of the file from some place on, through a buffer.
class Bytes {
public:
    explicit Bytes(const PictureFile& file) : file_(file) {}

    /// The next byte, -1 at the end.
    int get() {
        if (at_ < start_ || at_ >= start_ + std::int64_t(buffer_.size())) {
            start_ = at_;
            buffer_.resize(4096);
            buffer_.resize(std::size_t(file_.read(start_, buffer_.data(), 4096)));
            if (buffer_.empty()) return -1;
        }
        return static_cast<unsigned char>(buffer_[std::size_t(at_++ - start_)]);
    }
    std::int64_t tell() const noexcept { return at_; }
    void seek(std::int64_t at) noexcept { at_ = at; }
    std::int64_t size() const noexcept { return file_.size(); }
    /// Up to `count` bytes.
    std::string next(std::int64_t count) {
        std::string bytes(std::size_t(count), '\0');
        bytes.resize(std::size_t(file_.read(at_, bytes.data(), count)));
        at_ += std::int64_t(bytes.size());
        return bytes;
    }

private:
    const PictureFile& file_;
    std::string buffer_;
    std::int64_t start_ = 0, at_ = 0;
};

/// A zero-terminated name; false when it runs past the end or past what OpenEXR allows.
bool read_name(Bytes& file, std::string& name) {
    name.clear();
    int c;
    while ((c = file.get()) > 0) {
        if (name.size() == 255) return false;
        name += char(c);
    }
    return c == 0;
}

bool printable_channels(const std::string& list) {
    for (std::size_t at = 0; at < list.size() && list[at];) {
        const std::size_t end = std::min(list.find('\0', at), list.size());
        for (; at < end; ++at)
            if (static_cast<unsigned char>(list[at]) < 32 || list[at] == 127) return false;
        at += 1 + 16; // the terminator, type, linearity and sampling
    }
    return true;
}

/// Reads attributes up to the empty name that ends them.
std::string read_part(Bytes& file, ExrPart& part) {
    std::string name, type;
    for (;;) {
        if (!read_name(file, name)) return "has a header that is cut short";
        if (name.empty()) return "";
        if (!read_name(file, type) || file.tell() + 4 > file.size()) return "has a header that is cut short";
        const std::int64_t size = std::int32_t(u32(file.next(4), 0)), at = file.tell();
        if (size < 0 || at + size > file.size()) return "has a header that runs past the end of the file";
        const std::string value = file.next(std::min<std::int64_t>(size, 1 << 16));
        file.seek(at + size);
        const auto span = [&](std::size_t low, std::size_t high) {
            return double(std::int32_t(u32(value, high))) - double(std::int32_t(u32(value, low))) + 1;
        };
        if (name == "channels") {
            part.channels = true;
            if (!printable_channels(value)) return "has a channel whose name cannot be printed";
        }
        if (name == "compression" && size == 1) part.compression = true, part.method = value[0];
        if (name == "dataWindow" && size == 16)
            part.data_window = true, part.width = span(0, 8), part.height = span(4, 12);
        if (name == "displayWindow" && size == 16) part.display_window = true;
        if (name == "tiles" && size == 9) part.tile_width = u32(value, 0), part.tile_height = u32(value, 4);
    }
}

} // namespace

// openexr.com, "OpenEXR File Layout". The library falls back to a data window of 64 x 64 where there is none, and gives
// zeros for chunks of no bytes.
std::string exr_fault(const PictureFile& picture) {
    const std::uint32_t version = u32(picture.head(), 4);
    Bytes file(picture);
    file.seek(8);
    ExrPart first;
    std::string fault = read_part(file, first);
    const bool many_parts = version & 0x1000;
    while (fault.empty() && many_parts && file.next(1) > std::string(1, '\0')) {
        file.seek(file.tell() - 1);
        ExrPart other;
        fault = read_part(file, other);
    }
    if (!fault.empty()) return fault;
    for (const auto& [there, name] : {std::pair(first.channels, "channels"),
                                      {first.compression, "compression"},
                                      {first.data_window, "dataWindow"},
                                      {first.display_window, "displayWindow"}})
        if (!there) return "has a header without " + std::string(name);
    if (16 * first.chunks() > double(picture.size()))
        return "claims " + std::to_string(std::int64_t(first.width)) + " x " +
               std::to_string(std::int64_t(first.height)) + " pixels in " + std::to_string(picture.size()) + " bytes";
    return "";
}

} // namespace bake
