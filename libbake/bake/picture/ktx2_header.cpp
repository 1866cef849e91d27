// Khronos, "KTX File Format Specification" 2.0.
#include "bake/picture/ktx2_header.h"
#include "bake/picture/masked_texels.h"
#include <algorithm>
#include <iterator>

namespace bake {
namespace {

constexpr const char* mend = "export it again as RGBA, BC5 or BC6H without supercompression";
constexpr std::int64_t index_at = 80, index_bytes = 24;

/// The number that DXGI_FORMAT has for a VkFormat; 0: not read.
std::uint32_t dxgi_of(std::uint32_t vulkan) noexcept {
    constexpr std::uint32_t pairs[][2] = {
        {9, 61},  {16, 49}, {37, 28},  {43, 29},  {44, 87}, {50, 91}, {70, 56},  {76, 54},  {77, 35},  {83, 34},
        {91, 11}, {97, 10}, {100, 41}, {103, 16}, {106, 6}, {109, 2}, {123, 67}, {141, 83}, {143, 95},
    };
    for (const auto& [from, to] : pairs)
        if (from == vulkan) return to;
    return 0;
}

std::uint32_t word(const PictureFile& file, std::size_t at) noexcept { return little_endian(file.head(), at, 4); }

/// 8 bytes, at most 2^62.
std::int64_t place(const PictureFile& file, std::size_t at) noexcept {
    return std::int64_t(word(file, at)) | std::int64_t(std::min(word(file, at + 4), 0x3fffffffu)) << 32;
}

void check_kind(const PictureFile& file) {
    const auto unsuitable = [&](const char* why) { return Error(Refusal::unsuitable, file.path() + ": " + why); };
    if (word(file, 28) > 0) throw unsuitable("is a volume; give a flat image");
    const std::uint32_t faces = word(file, 36);
    if (faces != 1 && faces != 6) throw unreadable(file.path(), "has " + std::to_string(faces) + " faces");
    if (faces == 6 && word(file, 20) != word(file, 24)) throw unreadable(file.path(), "has faces that are not square");
    if (word(file, 44) != 0) throw unreadable(file.path(), "is supercompressed, which is not read", mend);
}

/// The value of a key, empty if there is none: the pairs stand one behind the other, each padded to four bytes.
std::string value_of(const PictureFile& file, const std::string& key) {
    const std::int64_t at = word(file, 56), size = std::min<std::int64_t>(word(file, 60), 1 << 20);
    std::string pairs(std::size_t(size), '\0');
    pairs.resize(std::size_t(std::max<std::int64_t>(0, file.read(at, pairs.data(), size))));
    for (std::size_t begin = 0; begin + 4 < pairs.size();) {
        const std::size_t length = little_endian(pairs, begin, 4);
        const std::string pair = pairs.substr(begin + 4, length);
        if (pair.compare(0, key.size() + 1, key + '\0') == 0) return pair.substr(key.size() + 1).c_str();
        begin += 4 + (length + 3) / 4 * 4;
    }
    return {};
}

/// Rows from the bottom up are said by the second letter of KTXorientation.
bool bottom_up(const PictureFile& file) {
    const std::string orientation = value_of(file, "KTXorientation");
    return orientation.size() > 1 && orientation[1] == 'u';
}

} // namespace

/// The descriptor says what the channels mean; the specification wants one of at least a basic block in every file.
void check_descriptor(const PictureFile& file) {
    constexpr std::uint32_t least = 4 + 24; // its own size, and a basic block without samples
    const std::uint32_t at = word(file, 48), size = word(file, 52);
    if (size < least || word(file, at) != size)
        throw unreadable(file.path(), "has no descriptor of its data format, which KTX2 requires", mend);
}

DdsHeader read_ktx2_header(const PictureFile& file) {
    if (std::int64_t(file.head().size()) < index_at + index_bytes) throw unreadable(file.path(), "is cut short");
    DdsHeader header;
    header.width = word(file, 20), header.height = std::max(1u, word(file, 24));
    if (header.width == 0) throw unreadable(file.path(), "has no pixels");
    if (std::max(header.width, header.height) > (1 << 20))
        throw unreadable(file.path(), "claims more pixels than a texture has room for");
    check_kind(file);
    const std::uint32_t vulkan = word(file, 12), dxgi = dxgi_of(vulkan);
    if (dxgi == 0 || !set_dxgi_texels(file, dxgi, header))
        throw unreadable(file.path(), "has texels of the format " + std::to_string(vulkan) + ", which are not read",
                         mend);
    header.arrays = std::max(1u, word(file, 32));
    constexpr std::int64_t most_levels = 32;
    const std::int64_t levels = std::max(1u, word(file, 40)), texels_at = index_at + levels * index_bytes;
    if (levels > most_levels) throw unreadable(file.path(), "claims more levels than a texture has");
    if (texels_at > file.size()) throw unreadable(file.path(), "is cut short");
    header.offset = place(file, std::size_t(index_at));
    header.faces = word(file, 36), header.levels = levels;
    header.face_bytes = level_bytes(header, 0);
    for (std::int64_t k = 0; k < levels; ++k) {
        const auto at = std::size_t(index_at + k * index_bytes);
        if (place(file, at) < texels_at || place(file, at) > file.size() ||
            place(file, at + 8) > file.size() - place(file, at))
            throw unreadable(file.path(), "is cut short");
        if (place(file, at + 8) / header.faces < level_bytes(header, k))
            throw unreadable(file.path(), "has a level that is smaller than its size says");
        header.level_at.push_back(place(file, at));
        header.face_step.push_back(level_bytes(header, k));
    }
    check_descriptor(file);
    if (bottom_up(file)) throw Error(Refusal::unsuitable, file.path() + ": is stored from the bottom up; turn it over");
    header.record = valid_record(value_of(file, record_key));
    return header;
}

} // namespace bake
