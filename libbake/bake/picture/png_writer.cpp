// W3C, "Portable Network Graphics", second edition; RFC 1950 and 1951. The blocks are joined as pigz joins its own: each is
// a deflate stream that ends at a byte boundary and is not the last, and begins with the 32 KiB before it as dictionary.
#include "bake/picture/png_writer.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>
#include <zlib.h>

namespace bake {
namespace {

using Byte = unsigned char;
using Bytes = std::vector<Byte>;

constexpr std::size_t block_bytes = 1 << 18, group_blocks = 32, window = 1 << 15;

void append_big_endian(Bytes& bytes, unsigned long value) {
    for (const int shift : {24, 16, 8, 0}) bytes.push_back(Byte(value >> shift));
}

enum Filter { none, sub, up, average, paeth, filter_count };

// The nearest of left, above and above left to left + above - above left; ties in that order. Selects, not branches, so
// that the loop over a row vectorises.
Byte paeth_of(Byte left, Byte above, Byte corner) noexcept {
    const auto towards_left = std::int16_t(above - corner), towards_above = std::int16_t(left - corner),
               towards_corner = std::int16_t(towards_left + towards_above);
    const auto size = [](std::int16_t n) { return std::int16_t(n < 0 ? -n : n); };
    const std::int16_t to_left = size(towards_left), to_above = size(towards_above), to_corner = size(towards_corner);
    const Byte other = to_above <= to_corner ? above : corner;
    return to_left <= std::min(to_above, to_corner) ? left : other;
}

/// Filters a row of `count` bytes; those `texel` bytes before it are 0.
template <Filter filter>
void apply(const Byte* row, const Byte* before, Byte* __restrict to, std::size_t count, int texel) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        const Byte left = row[std::ptrdiff_t(i) - texel], above = before[i], corner = before[std::ptrdiff_t(i) - texel];
        const Byte guess = filter == none      ? Byte(0)
                           : filter == sub     ? left
                           : filter == up      ? above
                           : filter == average ? Byte((left + above) / 2)
                                               : paeth_of(left, above, corner);
        to[i] = Byte(row[i] - guess);
    }
}

/// Sum of the bytes as signed numbers without their sign: the usual measure of how well a filtered row compresses.
std::uint64_t weight(const Byte* row, std::size_t count) noexcept {
    std::uint64_t sum = 0;
    for (std::size_t start = 0; start < count; start += 1 << 20) {
        std::uint32_t part = 0;
        for (std::size_t i = start; i < std::min(count, start + (1 << 20)); ++i)
            part += std::min<unsigned>(row[i], 256u - row[i]);
        sum += part;
    }
    return sum;
}

/// Writes the number of the best filter and the row filtered by it. The scratch has room for a row per filter.
void filter_row(const Byte* row, const Byte* before, Byte* to, std::size_t count, int texel, Byte* scratch) {
    constexpr decltype(&apply<none>) filters[] = {apply<none>, apply<sub>, apply<up>, apply<average>, apply<paeth>};
    std::uint64_t least = ~std::uint64_t(0);
    int best = none;
    for (int filter = none; filter < filter_count; ++filter) {
        Byte* const filtered = scratch + std::size_t(filter) * count;
        filters[filter](row, before, filtered, count, texel);
        if (const std::uint64_t found = weight(filtered, count); found < least) least = found, best = filter;
    }
    to[0] = Byte(best);
    std::memcpy(to + 1, scratch + std::size_t(best) * count, count);
}

/// Appends bytes [begin, end) deflated to `to`, up to a byte boundary. What comes before them, up to 32 KiB, is the
/// dictionary.
void deflate_to(Bytes& to, const Byte* first, std::size_t begin, std::size_t end, int strategy) {
    z_stream stream{};
    // Level 6 costs 3 times as much for 2 % of the size.
    if (deflateInit2(&stream, 3, Z_DEFLATED, -15, 9, strategy) != Z_OK) throw std::bad_alloc();
    const std::size_t known = std::min(begin, window);
    if (strategy != Z_RLE && known > 0) deflateSetDictionary(&stream, first + begin - known, uInt(known));
    const std::size_t start = to.size();
    to.resize(start + deflateBound(&stream, uLong(end - begin)) + 16);
    stream.next_in = const_cast<Byte*>(first + begin), stream.avail_in = uInt(end - begin);
    stream.next_out = to.data() + start, stream.avail_out = uInt(to.size() - start);
    deflate(&stream, Z_SYNC_FLUSH);
    to.resize(to.size() - stream.avail_out);
    deflateEnd(&stream);
}

} // namespace

/// The compressed bytes of a block, and the checksum of what they hold.
struct PngWriter::Block {
    Bytes bytes;
    unsigned long checksum = 1;
};

PngWriter::PngWriter(const std::string& path, const OutputFile& file, const PictureSize& size,
                     const WriteOptions& options)
    : path_(path), file_(nullptr), sample_bytes_(options.depth == Depth::u16 ? 2 : 1),
      texel_bytes_(sample_bytes_ * size.channels), row_bytes_(std::size_t(size.width) * std::size_t(texel_bytes_)),
      block_rows_(std::max<std::size_t>(1, block_bytes / (row_bytes_ + 1))),
      most_rows_(std::min(group_blocks * block_rows_, std::size_t(std::max(1, size.height)))) {
    if (options.mips) throw Error(Refusal::usage, path + ": PNG has no mips; write .exr or .tif");
    if (size.channels > 4) throw Error(Refusal::usage, path + ": PNG has at most 4 channels; write .exr or .tif");
    file_ = file.open_stream();
    rows_.assign((most_rows_ + 1) * (std::size_t(texel_bytes_) + row_bytes_), 0);
    filtered_.resize(window + most_rows_ * (row_bytes_ + 1));

    put("\x89PNG\r\n\x1a\n", 8);
    Bytes header;
    append_big_endian(header, unsigned(size.width)), append_big_endian(header, unsigned(size.height));
    constexpr Byte colour_types[] = {0, 0, 4, 2, 6};
    header.insert(header.end(), {Byte(8 * sample_bytes_), colour_types[size.channels], 0, 0, 0});
    put_chunk("IHDR", header);
    if (options.colour == ColourSpace::srgb) {
        put_chunk("sRGB", {0}); // perceptual, as most programs write
        put_chunk("gAMA", {0, 0, 45455 >> 8, 45455 & 255});
    }
    if (options.colour == ColourSpace::linear) put_chunk("gAMA", {0, 1, 100000 >> 8 & 255, 100000 & 255});
    const auto put_text = [this](const char* type, const std::string& text) {
        put_chunk(type, Bytes(text.begin(), text.end()));
    };
    if (!options.description.empty()) put_text("tEXt", std::string("Description") + '\0' + options.description);
    // Not compressed, in no language, and under no translated keyword.
    if (const std::string record = record_text(options.facts); !record.empty())
        put_text("iTXt", record_key + std::string(5, '\0') + record);
}

PngWriter::~PngWriter() {
    if (file_) std::fclose(file_);
}

void PngWriter::fail() const { refuse_unwritten(path_, std::strerror(errno)); }

void PngWriter::put(const void* bytes, std::size_t size) {
    if (std::fwrite(bytes, 1, size, file_) != size) fail();
}

void PngWriter::put_chunk(const char* type, const Bytes& data) {
    Bytes ends;
    append_big_endian(ends, data.size());
    ends.insert(ends.end(), type, type + 4);
    const unsigned long start = crc32_z(0, ends.data() + 4, 4);
    append_big_endian(ends, data.empty() ? start : crc32_z(start, data.data(), data.size()));
    put(ends.data(), 8);
    if (!data.empty()) put(data.data(), data.size()); // fwrite takes no null pointer
    put(ends.data() + 8, 4);
}

void PngWriter::write(const void* levels, int rows) {
    const auto* from = static_cast<const Byte*>(levels);
    const std::size_t room = std::size_t(texel_bytes_);
    for (; rows > 0; --rows, from += row_bytes_) {
        Byte* const to = rows_.data() + (waiting_ + 1) * (room + row_bytes_) + room;
        if (sample_bytes_ == 1) std::memcpy(to, from, row_bytes_);
        for (std::size_t i = 0; sample_bytes_ == 2 && i < row_bytes_; i += 2) {
            std::uint16_t level;
            std::memcpy(&level, from + i, 2);
            to[i] = Byte(level >> 8), to[i + 1] = Byte(level);
        }
        if (++waiting_ == most_rows_) compress_rows();
    }
}

PngWriter::Block PngWriter::compress(std::size_t begin, std::size_t end) const {
    // Noisy rows have no repetitions but runs of one byte, and looking for others costs most of the time. Patterns have.
    // A part of the block tells which it is.
    const std::size_t middle = begin + (end - begin) / 2, sample_end = std::min(end, middle + block_bytes / 32);
    Bytes runs, matches;
    deflate_to(runs, filtered_.data(), middle, sample_end, Z_RLE);
    deflate_to(matches, filtered_.data(), middle, sample_end, Z_DEFAULT_STRATEGY);
    Block block;
    deflate_to(block.bytes, filtered_.data(), begin, end, runs.size() <= matches.size() ? Z_RLE : Z_DEFAULT_STRATEGY);
    block.checksum = adler32_z(1, filtered_.data() + begin, end - begin);
    return block;
}

/// Compresses and writes the rows that wait.
void PngWriter::compress_rows() {
    const std::size_t room = std::size_t(texel_bytes_), stride = room + row_bytes_, line = row_bytes_ + 1;
    for_rows(std::int64_t(waiting_), std::int64_t(block_rows_), [&](std::int64_t begin, std::int64_t end) {
        Bytes scratch(std::size_t(filter_count) * row_bytes_);
        for (auto y = std::size_t(begin); y < std::size_t(end); ++y) {
            const Byte* const before = rows_.data() + y * stride + room;
            filter_row(before + stride, before, filtered_.data() + history_ + y * line, row_bytes_, texel_bytes_,
                       scratch.data());
        }
    });
    const std::size_t blocks = (waiting_ + block_rows_ - 1) / block_rows_;
    std::vector<Block> done(blocks);
    const auto end_of = [&](std::size_t block) {
        return history_ + std::min(waiting_, (block + 1) * block_rows_) * line;
    };
    for_rows(std::int64_t(blocks), 1, [&](std::int64_t block, std::int64_t) {
        const std::size_t begin = history_ + std::size_t(block) * block_rows_ * line;
        done[std::size_t(block)] = compress(begin, end_of(std::size_t(block)));
    });
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::size_t begin = history_ + i * block_rows_ * line;
        checksum_ = adler32_combine(checksum_, done[i].checksum, z_off_t(end_of(i) - begin));
        if (!std::exchange(begun_, true)) done[i].bytes.insert(done[i].bytes.begin(), {0x78, 0x01});
        put_chunk("IDAT", done[i].bytes);
    }
    // The last row and the last bytes are what the next rows are compared with.
    std::memcpy(rows_.data(), rows_.data() + waiting_ * stride, stride);
    const std::size_t filled = history_ + waiting_ * line, kept = std::min(filled, window);
    std::memmove(filtered_.data(), filtered_.data() + filled - kept, kept);
    history_ = kept, waiting_ = 0;
}

void PngWriter::finish() {
    if (waiting_ > 0) compress_rows();
    Bytes end = {0x03, 0x00}; // an empty block that is the last
    append_big_endian(end, checksum_);
    put_chunk("IDAT", end);
    put_chunk("IEND", {});
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail();
}

} // namespace bake
