// Ward, "Real Pixels", Graphics Gems II, 1991; Radiance's "Picture File Format".
#include "bake/picture/rgbe.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include "bake/picture/upright.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace bake {
namespace {

using Texel = std::array<unsigned char, 4>; // mantissas of red, green and blue, and their exponent

/// The bytes of the file in their order, through a buffer.
class Source {
public:
    explicit Source(const PictureFile& file) : file_(file), buffer_(1 << 16) {}

    unsigned char next() {
        if (at_ == end_) {
            end_ = std::size_t(file_.read(offset_, buffer_.data(), std::int64_t(buffer_.size())));
            at_ = 0, offset_ += std::int64_t(end_);
            if (end_ == 0) throw unreadable(file_.path(), "is cut short");
        }
        return static_cast<unsigned char>(buffer_[at_++]);
    }
    std::string next_line() {
        std::string line;
        for (unsigned char c; (c = next()) != '\n';)
            if (line.size() < 4096) line += char(c); // comments may be of any length
        return line;
    }
    Texel next_texel() { return {next(), next(), next(), next()}; }

private:
    const PictureFile& file_;
    std::vector<char> buffer_;
    std::int64_t offset_ = 0;
    std::size_t at_ = 0, end_ = 0;
};

struct Header {
    int rows = 0, columns = 0; ///< as stored
    int orientation = 1;
    double exposure = 1;
    std::array<double, 3> correction = {1, 1, 1};
    bool xyz = false;
    std::string primaries = {};
};

/// The line "-Y 512 +X 1024" and its seven kin: the first axis runs from stored row to stored row.
void read_resolution(const PictureFile& file, const std::string& line, Header& header) {
    char signs[2], axes[2];
    if (std::sscanf(line.c_str(), "%c%c %d %c%c %d", &signs[0], &axes[0], &header.rows, &signs[1], &axes[1],
                    &header.columns) != 6)
        throw unreadable(file.path(), "has no line with its size");
    struct Order {
        const char* axes;
        int orientation;
    };
    constexpr Order orders[] = {{"-Y+X", 1}, {"-Y-X", 2}, {"+Y-X", 3}, {"+Y+X", 4},
                                {"+X-Y", 5}, {"-X-Y", 6}, {"-X+Y", 7}, {"+X+Y", 8}};
    const std::string found{signs[0], axes[0], signs[1], axes[1]};
    for (const Order& order : orders)
        if (found == order.axes) {
            header.orientation = order.orientation;
            return;
        }
    throw unreadable(file.path(), "has axes in no known order");
}

Header read_header(const PictureFile& file, Source& source) {
    Header header;
    for (std::string line = source.next_line(); !line.empty() && line != "\r"; line = source.next_line()) {
        const auto value = [&](std::string_view name) {
            return line.starts_with(name) ? line.c_str() + name.size() : nullptr;
        };
        if (const char* format = value("FORMAT=")) {
            header.xyz = std::string_view(format).find("xyze") != std::string_view::npos;
            if (!header.xyz && std::string_view(format).find("rgbe") == std::string_view::npos)
                throw unreadable(file.path(), "is in the format" + std::string(" ") + format + ", which is not read");
        }
        if (const char* exposure = value("EXPOSURE=")) {
            const double factor = std::atof(exposure); // several multiply
            if (factor > 0 && std::isfinite(factor)) header.exposure *= factor;
        }
        if (const char* correction = value("COLORCORR=")) {
            double c[3];
            if (std::sscanf(correction, "%lf %lf %lf", &c[0], &c[1], &c[2]) == 3 && std::min({c[0], c[1], c[2]}) > 0)
                for (std::size_t i = 0; i < 3; ++i) header.correction[i] *= c[i];
        }
        if (const char* primaries = value("PRIMARIES=")) header.primaries = primaries;
    }
    read_resolution(file, source.next_line(), header);
    return header;
}

/// Texels and runs of the first versions: mantissas of 1 repeat the texel before, as often as the exponent says; further
/// ones count in the next 8 bits.
void read_old_row(const PictureFile& file, Source& source, Texel first, std::vector<Texel>& row) {
    std::size_t at = 0;
    int shift = 0;
    for (Texel texel = first;; texel = source.next_texel()) {
        if (texel[0] == 1 && texel[1] == 1 && texel[2] == 1) {
            const std::size_t count = shift < 24 ? std::size_t(texel[3]) << shift : row.size() + 1;
            if (at == 0 || count > row.size() - at)
                throw unreadable(file.path(), "has a run beyond the end of its row");
            std::fill_n(row.begin() + std::ptrdiff_t(at), count, row[at - 1]);
            at += count, shift += 8;
        } else {
            row[at++] = texel, shift = 0;
        }
        if (at == row.size()) return;
    }
}

void read_row(const PictureFile& file, Source& source, std::vector<Texel>& row) {
    const Texel first = source.next_texel();
    const bool by_component =
        row.size() >= 8 && row.size() <= 0x7fff && first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (!by_component) return read_old_row(file, source, first, row);
    if (std::size_t(first[2]) << 8 != row.size() - first[3])
        throw unreadable(file.path(), "has a row of another length than the others");
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t at = 0; at < row.size();) {
            const unsigned char code = source.next();
            const std::size_t count = code > 128 ? code - 128u : code;
            if (count == 0 || count > row.size() - at)
                throw unreadable(file.path(), "has a run beyond the end of its row");
            unsigned char value = code > 128 ? source.next() : static_cast<unsigned char>(0);
            for (const std::size_t end = at + count; at < end; ++at) {
                if (code <= 128) value = source.next();
                row[at][c] = value;
            }
        }
}

ImageInfo describe(const Header& header) {
    ImageInfo info;
    info.format = "hdr";
    info.width = header.columns, info.height = header.rows;
    info.channels = {"R", "G", "B"};
    info.colours = 3;
    info.type = SampleType::float32, info.bits = 32;
    const bool corrected = header.correction != std::array<double, 3>{1, 1, 1};
    if (header.exposure != 1 || corrected)
        info.notes.push_back(format("was divided by its EXPOSURE of %g", header.exposure) +
                             (corrected ? " and by its COLORCORR" : "") + ", as the format asks for");
    float p[8] = {};
    constexpr float srgb[] = {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f}; // Radiance's own differ by 0.01 in one number
    const int numbers =
        std::sscanf(header.primaries.c_str(), "%f %f %f %f %f %f", &p[0], &p[1], &p[2], &p[3], &p[4], &p[5]);
    if (numbers == 6 && *std::max_element(p, p + 6) > 0) // Photoshop writes zeros for those that it does not know
        for (int i = 0; i < 6; ++i)
            if (std::abs(p[i] - srgb[i]) > 0.015f)
                info.colour.note = "has other primaries than sRGB: its colours are not converted";
    return info;
}

} // namespace

void read_rgbe(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    Source source(file);
    const Header header = read_header(file, source);
    info = describe(header);
    const Window window{0, 0, header.columns, header.rows};
    check_size(file.path(), file.size(), {window, window, 3}, limits);
    turn_upright(info, header.orientation);
    if (!image) return;
    Image<float> stored(header.columns, header.rows, 3);
    std::vector<Texel> row(std::size_t(header.columns));
    float gain[3];
    for (std::size_t c = 0; c < 3; ++c) gain[c] = float(1 / (header.exposure * header.correction[c]));
    for (int y = 0; y < header.rows; ++y) {
        if (y % 256 == 0) throw_if_interrupted();
        read_row(file, source, row);
        float* to = stored.row(y);
        for (const Texel& texel : row) {
            const float unit = texel[3] == 0 ? 0 : std::ldexp(1.0f, int(texel[3]) - 136);
            float rgb[3];
            for (int c = 0; c < 3; ++c) rgb[c] = float(texel[std::size_t(c)]) * unit;
            if (header.xyz) { // by Radiance's matrix for its own primaries
                const float x = rgb[0], y_ = rgb[1], z = rgb[2];
                rgb[0] = 2.5653f * x - 1.1665f * y_ - 0.3986f * z;
                rgb[1] = -1.0221f * x + 1.9783f * y_ + 0.0438f * z;
                rgb[2] = 0.0747f * x - 0.2519f * y_ + 1.1772f * z;
            }
            for (int c = 0; c < 3; ++c) *to++ = rgb[c] * gain[c];
        }
    }
    *image = upright(std::move(stored), header.orientation);
}

} // namespace bake
