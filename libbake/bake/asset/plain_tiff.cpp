#include "bake/asset/plain_tiff.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

namespace bake {
namespace {

enum Tag : std::uint16_t {
    subfile = 254, width = 256, height = 257, bits = 258, compression = 259, photometric = 262, strip_offsets = 273,
    orientation = 274, samples = 277, rows_per_strip = 278, strip_counts = 279, planar = 284, extra_samples = 338,
    sample_format = 339
};
enum FieldType : std::uint16_t { short_field = 3, long_field = 4 };

constexpr std::uint32_t min_is_black = 1, rgb = 2, unsigned_samples = 1, float_samples = 3;

// Tags that say nothing about the samples: names, dates, resolution.
constexpr std::uint16_t remarks[] = {269, 270, 271, 272, 282, 283, 296, 305, 306, 315, 316, 33432};

#pragma pack(push, 2)
struct Entry {
    std::uint16_t tag, type;
    std::uint32_t count, value;
};
#pragma pack(pop)
static_assert(sizeof(Entry) == 12);

/// A file that is closed in the end.
class ReadFile {
public:
    explicit ReadFile(const std::string& path) : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
    ~ReadFile() {
        if (file_ >= 0) close(file_);
    }
    ReadFile(const ReadFile&) = delete;
    ReadFile& operator=(const ReadFile&) = delete;

    bool read(std::int64_t at, void* to, std::int64_t count) const {
        for (auto* bytes = static_cast<char*>(to); count > 0;) {
            const ssize_t got = pread(file_, bytes, std::size_t(count), at);
            if (got <= 0) return false;
            bytes += got, at += got, count -= got;
        }
        return true;
    }

private:
    int file_;
};

/// All the values of one entry; none where it is missing or of another type.
std::vector<std::uint32_t> values_of(const ReadFile& file, const std::vector<Entry>& entries, std::uint16_t tag) {
    const auto entry = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.tag == tag; });
    if (entry == entries.end() || (entry->type != short_field && entry->type != long_field) || entry->count > (1 << 20)) return {};
    const std::size_t size = entry->type == short_field ? 2 : 4;
    std::vector<unsigned char> bytes(std::max<std::size_t>(entry->count * size, 4));
    if (entry->count * size <= 4)
        std::memcpy(bytes.data(), &entry->value, 4);
    else if (!file.read(entry->value, bytes.data(), std::int64_t(entry->count * size)))
        return {};
    std::vector<std::uint32_t> values(entry->count, 0);
    for (std::size_t i = 0; i < values.size(); ++i) std::memcpy(&values[i], bytes.data() + i * size, size);
    return values;
}

/// The first directory of a little-endian TIFF; nothing for others. `alone`: it is the only one.
std::vector<Entry> read_entries(const ReadFile& file, bool& alone) {
    struct { char order[2]; std::uint16_t version; std::uint32_t first; } header;
    std::uint16_t count = 0;
    if (!file.read(0, &header, sizeof header) || std::memcmp(header.order, "II", 2) != 0 || header.version != 42) return {};
    if (!file.read(header.first, &count, sizeof count) || count > 64) return {};
    std::vector<Entry> entries(count);
    std::uint32_t next = 0;
    const std::int64_t end = std::int64_t(header.first) + 2 + std::int64_t(count) * 12;
    if (!file.read(header.first + 2, entries.data(), std::int64_t(count) * 12) || !file.read(end, &next, 4)) return {};
    alone = next == 0;
    return entries;
}

bool all_known(const std::vector<Entry>& entries) {
    constexpr std::uint16_t known[] = {subfile, width, height, bits, compression, photometric, strip_offsets, orientation,
                                       samples, rows_per_strip, strip_counts, planar, sample_format};
    return std::all_of(entries.begin(), entries.end(), [&](const Entry& e) {
        return std::count(std::begin(known), std::end(known), e.tag) || std::count(std::begin(remarks), std::end(remarks), e.tag);
    });
}

/// The one value of a tag, `otherwise` where it is missing, -1 where it is something else.
std::int64_t one(const ReadFile& file, const std::vector<Entry>& entries, std::uint16_t tag, std::uint32_t otherwise) {
    const bool there = std::any_of(entries.begin(), entries.end(), [&](const Entry& e) { return e.tag == tag; });
    const std::vector<std::uint32_t> values = values_of(file, entries, tag);
    return values.size() == 1 ? values[0] : there ? -1 : std::int64_t(otherwise);
}

std::int64_t bytes_per_sample(const PlainTiff& tiff) { return tiff.info.bits / 8; }

template <class Level> void to_floats(const Level* levels, float* values, std::int64_t count) noexcept {
    constexpr float step = 1.0f / static_cast<float>(static_cast<Level>(-1));
    for (std::int64_t i = 0; i < count; ++i) values[i] = static_cast<float>(levels[i]) * step;
}

} // namespace

std::optional<PlainTiff> find_plain_tiff(const std::string& path, const ReadLimits& limits) {
    std::error_code failed;
    if (std::endian::native != std::endian::little || !std::filesystem::is_regular_file(path, failed)) return {};
    const auto stored = std::int64_t(std::filesystem::file_size(path, failed));
    const ReadFile file(path);
    bool alone = false;
    const std::vector<Entry> entries = read_entries(file, alone);
    if (entries.empty() || !alone || !all_known(entries)) return {};
    const auto one = [&](std::uint16_t tag, std::uint32_t otherwise) { return bake::one(file, entries, tag, otherwise); };
    const std::int64_t depth = one(bits, 1), format = one(sample_format, unsigned_samples);
    const bool floats = depth == 32 && format == float_samples, integers = (depth == 8 || depth == 16) && format == unsigned_samples;
    if (!(floats || integers) || one(subfile, 0) != 0 || one(compression, 1) != 1 || one(photometric, rgb) != min_is_black ||
        one(orientation, 1) != 1 || one(samples, 1) != 1 || one(planar, 1) != 1)
        return {};

    PlainTiff tiff;
    const std::int64_t w = one(width, 0), h = one(height, 0), strip = std::min(one(rows_per_strip, ~0u), h);
    if (w < 1 || h < 1 || w > (1 << 20) || h > (1 << 20) || strip < 1 || 4 * w * h > limits.max_bytes) return {};
    const std::vector<std::uint32_t> offsets = values_of(file, entries, strip_offsets), counts = values_of(file, entries, strip_counts);
    if (std::int64_t(offsets.size()) != (h + strip - 1) / strip || counts.size() != offsets.size()) return {};
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const std::int64_t needed = std::min(strip, h - std::int64_t(i) * strip) * w * depth / 8;
        if (counts[i] < needed || std::int64_t(offsets[i]) + needed > stored) return {};
        tiff.strips.push_back(offsets[i]);
    }
    tiff.rows_per_strip = int(strip);
    tiff.info = {.format = "tiff", .width = int(w), .height = int(h), .channels = {"Y"},
                 .type = floats ? SampleType::float32 : depth == 16 ? SampleType::u16 : SampleType::u8, .bits = int(depth)};
    return tiff;
}

bool is_cut_short_tiff(const std::string& path) {
    std::error_code failed;
    if (std::endian::native != std::endian::little || !std::filesystem::is_regular_file(path, failed)) return false;
    const auto stored = std::int64_t(std::filesystem::file_size(path, failed));
    const ReadFile file(path);
    bool alone = false;
    const std::vector<Entry> entries = read_entries(file, alone);
    const std::vector<std::uint32_t> depths = values_of(file, entries, bits);
    if (entries.empty() || depths.empty() || one(file, entries, compression, 1) != 1) return false;
    const std::int64_t h = one(file, entries, height, 0), strip = std::min(one(file, entries, rows_per_strip, ~0u), h);
    const std::int64_t row_bits = one(file, entries, width, 0) * one(file, entries, samples, 1) * depths[0];
    const std::vector<std::uint32_t> offsets = values_of(file, entries, strip_offsets), counts = values_of(file, entries, strip_counts);
    for (std::size_t i = 0; i < std::min(offsets.size(), counts.size()); ++i) {
        // Some writers claim a whole last strip where there are fewer rows.
        const std::int64_t needed = std::min(strip, h - std::int64_t(i) * strip) * (row_bits / 8);
        if (std::int64_t(offsets[i]) + std::min<std::int64_t>(counts[i], needed) > stored) return true;
    }
    return false;
}

Image<float> read_plain_tiff(const std::string& path, const PlainTiff& tiff) {
    const ReadFile file(path);
    const int columns = tiff.info.width;
    const std::int64_t row_bytes = columns * bytes_per_sample(tiff);
    Image<float> image(columns, tiff.info.height, 1);
    // Pieces small enough to stay in the cache between reading and converting.
    for_rows(tiff.info.height, std::max<std::int64_t>(1, (1 << 18) / row_bytes), [&](std::int64_t begin, std::int64_t end) {
        std::vector<unsigned char> levels(tiff.info.type == SampleType::float32 ? 0 : std::size_t((end - begin) * row_bytes));
        for (std::int64_t y = begin, last; y < end; y = last) {
            const std::int64_t strip = y / tiff.rows_per_strip;
            last = std::min(end, (strip + 1) * tiff.rows_per_strip);
            void* const to = levels.empty() ? static_cast<void*>(image.row(int(y))) : levels.data();
            if (!file.read(tiff.strips[strip] + (y - strip * tiff.rows_per_strip) * row_bytes, to, (last - y) * row_bytes))
                throw Error(Refusal::unreadable, path + ": cannot be read to its end; was it being written? run again");
            const std::int64_t count = (last - y) * columns;
            if (tiff.info.type == SampleType::u8) to_floats(levels.data(), image.row(int(y)), count);
            if (tiff.info.type == SampleType::u16) to_floats(reinterpret_cast<const std::uint16_t*>(levels.data()), image.row(int(y)), count);
        }
    });
    return image;
}

namespace {

constexpr std::int64_t strip_rows = 64;

std::int64_t row_bytes_of(const PictureSize& size, Depth depth) {
    return std::int64_t(size.width) * size.channels * (depth == Depth::u8 ? 1 : depth == Depth::u16 ? 2 : 4);
}

/// Everything before the samples.
std::vector<unsigned char> make_header(const PictureSize& size, const WriteOptions& options) {
    const std::int64_t row_bytes = row_bytes_of(size, options.depth), strip_count = (size.height + strip_rows - 1) / strip_rows;
    const auto strip_bytes = [&](std::int64_t i) { return std::min(strip_rows, size.height - i * strip_rows) * row_bytes; };
    const auto channels = std::uint32_t(size.channels), colours = channels < 3 ? 1u : 3u;
    const std::uint32_t depth_bits = options.depth == Depth::u8 ? 8 : options.depth == Depth::u16 ? 16 : 32;

    struct Field { std::uint16_t tag; FieldType type; std::vector<std::uint32_t> values; };
    std::vector<std::uint32_t> extra; // what the channels beyond grey or rgb are: 2 alpha that colours are not multiplied by, 0 anything
    for (std::uint32_t c = colours; c < channels; ++c) extra.push_back(options.channels[c] == "A" ? 2 : 0);
    std::vector<Field> fields = {
        {width, long_field, {std::uint32_t(size.width)}},
        {height, long_field, {std::uint32_t(size.height)}},
        {bits, short_field, std::vector<std::uint32_t>(channels, depth_bits)},
        {compression, short_field, {1}},
        {photometric, short_field, {colours == 1 ? min_is_black : rgb}},
        {strip_offsets, long_field, std::vector<std::uint32_t>(strip_count)},
        {orientation, short_field, {1}},
        {samples, short_field, {channels}},
        {rows_per_strip, long_field, {std::uint32_t(strip_rows)}},
        {strip_counts, long_field, std::vector<std::uint32_t>(strip_count)},
        {planar, short_field, {1}},
        {extra_samples, short_field, extra},
        {sample_format, short_field, std::vector<std::uint32_t>(channels, depth_bits == 32 ? float_samples : unsigned_samples)}};
    std::erase_if(fields, [](const Field& field) { return field.values.empty(); });

    const auto size_of = [](const Field& field) { return field.values.size() * (field.type == short_field ? 2 : 4); };
    const std::size_t directory = 8 + 2 + 12 * fields.size() + 4;
    std::size_t begin = directory; // of the samples, behind what does not fit the entries
    for (const Field& field : fields) begin += size_of(field) > 4 ? (size_of(field) + 3) / 4 * 4 : 0;
    begin = (begin + 15) / 16 * 16;
    for (Field& field : fields)
        for (std::int64_t i = 0; i < strip_count; ++i) {
            if (field.tag == strip_offsets) field.values[i] = std::uint32_t(std::int64_t(begin) + i * strip_rows * row_bytes);
            if (field.tag == strip_counts) field.values[i] = std::uint32_t(strip_bytes(i));
        }

    std::vector<unsigned char> header(begin, 0);
    const auto put = [&](std::size_t at, std::uint32_t value, std::size_t count) { std::memcpy(header.data() + at, &value, count); };
    std::memcpy(header.data(), "II*\0", 4);
    put(4, 8, 4);
    put(8, std::uint32_t(fields.size()), 2);
    std::size_t entry = 10, beyond = directory;
    for (const Field& field : fields) {
        const std::size_t each = field.type == short_field ? 2 : 4;
        put(entry, field.tag, 2), put(entry + 2, field.type, 2), put(entry + 4, std::uint32_t(field.values.size()), 4);
        std::size_t at = entry + 8;
        if (size_of(field) > 4) put(at, std::uint32_t(beyond), 4), at = beyond, beyond += (size_of(field) + 3) / 4 * 4;
        for (std::size_t i = 0; i < field.values.size(); ++i) put(at + i * each, field.values[i], each);
        entry += 12;
    }
    return header;
}

} // namespace

bool fits_plain_tiff(const std::string& path, const PictureSize& size, const WriteOptions& options) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    const std::int64_t header_room = 1 << 20;
    return std::endian::native == std::endian::little && (ending == ".tif" || ending == ".tiff") && !options.mips &&
           options.compression != Compression::zip && size.width > 0 && size.height > 0 && size.channels > 0 &&
           size.height * row_bytes_of(size, options.depth) < (std::int64_t(1) << 32) - header_room;
}

PlainTiffWriter::PlainTiffWriter(const std::string& path, const std::string& temporary, const PictureSize& size, const WriteOptions& options)
    : path_(path), row_bytes_(std::size_t(row_bytes_of(size, options.depth))), file_(open(temporary.c_str(), O_WRONLY | O_CLOEXEC)) {
    // Not truncated: the file is empty, and ext4 writes a truncated one to the disk before it closes it.
    const std::vector<unsigned char> header = make_header(size, options);
    write_bytes(header.data(), header.size());
}

PlainTiffWriter::~PlainTiffWriter() {
    if (file_ >= 0) close(file_);
}

void PlainTiffWriter::write_bytes(const void* bytes, std::size_t count) {
    for (auto* from = static_cast<const char*>(bytes); count > 0;) {
        const ssize_t put = ::write(file_, from, count);
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) throw Error(Refusal::unwritable, path_ + ": cannot be written (" + std::strerror(errno) + "); is the disk full?");
        from += put, count -= std::size_t(put);
    }
}

void PlainTiffWriter::write(const void* values, int rows) { write_bytes(values, std::size_t(rows) * row_bytes_); }

void PlainTiffWriter::finish() {
    const bool closed = close(file_) == 0;
    file_ = -1;
    if (!closed) throw Error(Refusal::unwritable, path_ + ": cannot be written (" + std::strerror(errno) + "); is the disk full?");
}

} // namespace bake
