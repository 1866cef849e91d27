// Microsoft, "Programming Guide for DDS"; "DXGI_FORMAT enumeration".
#include "bake/picture/dds_header.h"
#include "bake/base/text.h"
#include "bake/picture/masked_texels.h"
#include <algorithm>
#include <cctype>
#include <iterator>

namespace bake {
namespace {

enum PixelFlag : std::uint32_t {
    alpha_pixels = 0x1,
    alpha_only = 0x2,
    four_characters = 0x4,
    rgb = 0x40,
    grey = 0x20000
};

/// Texels of at most 32 bits, by the masks of red, green, blue and alpha; a mask of 0 stands for no channel.
struct MaskedFormat {
    std::uint32_t code, bits, masks[4];
    bool srgb = false;
};

constexpr MaskedFormat dxgi_masked[] = {
    {24, 32, {0x3ff, 0xffc00, 0x3ff00000, 0xc0000000}}, // R10G10B10A2
    {28, 32, {0xff, 0xff00, 0xff0000, 0xff000000}},     // R8G8B8A8
    {29, 32, {0xff, 0xff00, 0xff0000, 0xff000000}, true},
    {35, 32, {0xffff, 0xffff0000, 0, 0}},           // R16G16
    {49, 16, {0xff, 0xff00, 0, 0}},                 // R8G8
    {56, 16, {0xffff, 0, 0, 0}},                    // R16
    {61, 8, {0xff, 0, 0, 0}},                       // R8
    {85, 16, {0xf800, 0x7e0, 0x1f, 0}},             // B5G6R5
    {86, 16, {0x7c00, 0x3e0, 0x1f, 0x8000}},        // B5G5R5A1
    {87, 32, {0xff0000, 0xff00, 0xff, 0xff000000}}, // B8G8R8A8
    {88, 32, {0xff0000, 0xff00, 0xff, 0}},          // B8G8R8X8
    {91, 32, {0xff0000, 0xff00, 0xff, 0xff000000}, true},
    {93, 32, {0xff0000, 0xff00, 0xff, 0}, true},
    {115, 16, {0xf00, 0xf0, 0xf, 0xf000}}, // B4G4R4A4
};

/// Texels of samples of one type, one after the other.
struct SampledFormat {
    std::uint32_t code;
    SampleType type;
    std::size_t channels;
};

constexpr SampledFormat dxgi_sampled[] = {
    {2, SampleType::float32, 4},  {6, SampleType::float32, 3},  {10, SampleType::half, 4}, {11, SampleType::u16, 4},
    {13, SampleType::i16, 4},     {16, SampleType::float32, 2}, {34, SampleType::half, 2}, {37, SampleType::i16, 2},
    {41, SampleType::float32, 1}, {54, SampleType::half, 1},    {58, SampleType::i16, 1},
};

/// D3DFORMAT, which stands where four characters would.
constexpr SampledFormat direct3d9_sampled[] = {
    {36, SampleType::u16, 4},      {110, SampleType::i16, 4},     {111, SampleType::half, 1},
    {112, SampleType::half, 2},    {113, SampleType::half, 4},    {114, SampleType::float32, 1},
    {115, SampleType::float32, 2}, {116, SampleType::float32, 4},
};

std::uint32_t word(const PictureFile& file, std::size_t at) noexcept { return little_endian(file.head(), at, 4); }

/// Bytes of a block of 4 x 4 texels; 0 for what is no known compression.
std::int64_t block_bytes(const std::string& code, std::uint32_t dxgi) noexcept {
    const auto is = [&](std::initializer_list<const char*> codes) {
        return std::find(codes.begin(), codes.end(), code) != codes.end();
    };
    const auto within = [&](std::uint32_t low, std::uint32_t high) {
        return code == "DX10" && dxgi >= low && dxgi <= high;
    };
    if (is({"DXT1", "ATI1", "BC4U", "BC4S"}) || within(70, 72) || within(79, 81)) return 8;
    const bool large = is({"DXT2", "DXT3", "DXT4", "DXT5", "ATI2", "BC5U", "BC5S"});
    return large || within(73, 78) || within(82, 84) || within(94, 99) ? 16 : 0;
}

void set_samples(const SampledFormat& format, DdsHeader& header) {
    constexpr const char* names[] = {"R", "G", "B", "A"};
    header.type = format.type;
    header.channels.assign(names, names + format.channels);
    if (format.channels == 4) header.alpha_channel = 3;
    header.texel_bytes = std::int64_t(format.channels) * (format.type == SampleType::float32 ? 4 : 2);
}

void set_masks(const PictureFile& file, const MaskedFormat& format, const char* const* names, DdsHeader& header) {
    if (format.bits < 8 || format.bits > 32 || format.bits % 8 != 0)
        throw unreadable(file.path(), "has texels of " + std::to_string(format.bits) + " bits, which are not read");
    header.texel_bytes = format.bits / 8;
    header.srgb = format.srgb;
    for (std::size_t c = 0; c < 4; ++c) {
        if (format.masks[c] == 0) continue;
        if (std::uint64_t(format.masks[c]) >> format.bits)
            throw unreadable(file.path(), "has a channel whose mask exceeds its texels");
        if (c == 3 && !header.channels.empty()) header.alpha_channel = int(header.channels.size());
        header.masks.push_back(format.masks[c]);
        header.channels.emplace_back(names[c]);
    }
    if (header.masks.empty()) throw unreadable(file.path(), "has no channel: all its masks are 0");
}

/// Texels that the header describes by masks.
void read_masks(const PictureFile& file, DdsHeader& header) {
    const std::uint32_t flags = word(file, 80);
    if (!(flags & (rgb | grey | alpha_only)))
        throw unreadable(file.path(), "has texels that are neither colours nor grey", "export it again as RGBA");
    MaskedFormat format{0, word(file, 88), {}};
    const std::size_t colours = flags & rgb ? 3 : flags & grey ? 1 : 0;
    for (std::size_t c = 0; c < colours; ++c) format.masks[c] = word(file, 92 + 4 * c);
    if (flags & (alpha_pixels | alpha_only)) format.masks[3] = word(file, 104);
    constexpr const char *rgba[] = {"R", "G", "B", "A"}, *ya[] = {"Y", "", "", "A"};
    set_masks(file, format, flags & rgb ? rgba : ya, header);
}

template <class Format> const Format* find(const Format* begin, const Format* end, std::uint32_t code) noexcept {
    const Format* const found = std::find_if(begin, end, [&](const Format& format) { return format.code == code; });
    return found == end ? nullptr : found;
}

/// Texels that a code describes: of four characters, a number of D3DFORMAT, or a number of DXGI_FORMAT.
void read_code(const PictureFile& file, DdsHeader& header) {
    const std::string code = file.head().substr(84, 4);
    const bool extended = code == "DX10";
    const std::uint32_t number = word(file, extended ? 128 : 84);
    if (extended) header.offset += 20;
    if (file.size() < header.offset) throw unreadable(file.path(), "is cut short");
    if (extended && set_dxgi_texels(file, number, header)) return;
    if (!extended && (header.block_bytes = block_bytes(code, number)) > 0) return;
    if (const auto* sampled = find(std::begin(direct3d9_sampled), std::end(direct3d9_sampled), number);
        sampled && !extended)
        return set_samples(*sampled, header);
    const bool printable = std::all_of(code.begin(), code.end(), [](unsigned char c) { return std::isprint(c); });
    throw unreadable(file.path(),
                     "has texels of the format " + (printable && !extended ? code : std::to_string(number)) +
                         ", which are not read",
                     "export it again as RGBA, float or BC1 to BC7");
}

/// Cube maps, mip levels and arrays.
void read_parts(const PictureFile& file, DdsHeader& header) {
    constexpr std::uint32_t counts_levels = 0x20000, has_levels = 0x400000, cube = 0x200, volume = 0x200000;
    const std::uint32_t more = word(file, 112);
    const bool extended = header.offset > 128;
    const auto unsuitable = [&](const std::string& why) {
        return Error(Refusal::unsuitable, file.path() + ": " + why);
    };
    if ((more & volume) || (extended && word(file, 132) == 4)) throw unsuitable("is a volume; give a flat image");
    if ((word(file, 8) & counts_levels) || (word(file, 108) & has_levels)) {
        std::int64_t chain = 1;
        while ((std::max(header.width, header.height) >> chain) > 0) ++chain;
        header.levels = std::clamp<std::int64_t>(word(file, 28), 1, chain);
    }
    if (extended) header.arrays = std::max<std::int64_t>(1, word(file, 140));
    if (more & cube) {
        std::string sides;
        constexpr const char* names[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
        for (std::size_t k = 0; k < 6; ++k)
            if (more & (0x400u << k)) sides += (sides.empty() ? "" : " ") + std::string(names[k]);
        header.faces = 6;
        if (sides.size() != 17)
            throw unsuitable("is a cube map of the faces " + sides + " only; give one of all six faces");
    } else if (extended && (word(file, 136) & 4)) {
        header.faces = 6;
    }
}

} // namespace

std::int64_t level_bytes(const DdsHeader& header, std::int64_t level) noexcept {
    const std::int64_t width = std::max<std::int64_t>(1, header.width >> level),
                       height = std::max<std::int64_t>(1, header.height >> level);
    return header.block_bytes > 0 ? (width + 3) / 4 * ((height + 3) / 4) * header.block_bytes
                                  : width * height * header.texel_bytes;
}

bool set_dxgi_texels(const PictureFile& file, std::uint32_t number, DdsHeader& header) {
    constexpr const char* names[] = {"R", "G", "B", "A"};
    header.code = number == 83 ? TexelCode::bc5 : number == 95 ? TexelCode::bc6h : TexelCode::samples;
    if (number == 67) {
        header.code = TexelCode::rgb9e5, header.texel_bytes = 4;
        return true;
    }
    if ((header.block_bytes = block_bytes("DX10", number)) > 0) return true;
    if (const auto* masked = find(std::begin(dxgi_masked), std::end(dxgi_masked), number))
        return set_masks(file, *masked, names, header), true;
    if (const auto* sampled = find(std::begin(dxgi_sampled), std::end(dxgi_sampled), number))
        return set_samples(*sampled, header), true;
    return false;
}

DdsHeader read_dds_header(const PictureFile& file) {
    DdsHeader header;
    if (file.head().size() < 128) throw unreadable(file.path(), "is cut short");
    header.height = word(file, 12), header.width = word(file, 16);
    if (std::min(header.width, header.height) == 0) throw unreadable(file.path(), "has no pixels");
    if (std::max(header.width, header.height) > (1 << 20))
        throw unreadable(file.path(), "claims more pixels than DDS has room for");
    if (word(file, 80) & four_characters) read_code(file, header);
    else read_masks(file, header);
    read_parts(file, header);
    for (std::int64_t level = 0; level < header.levels; ++level) {
        header.level_at.push_back(header.offset + header.face_bytes);
        header.face_bytes += level_bytes(header, level);
    }
    header.face_step.assign(header.level_at.size(), header.face_bytes);
    // In double: a damaged count of arrays overflows 64 bits.
    const double claimed = double(header.face_bytes) * double(header.faces) * double(header.arrays);
    if (double(file.size() - header.offset) < claimed) throw unreadable(file.path(), "is cut short");
    return header;
}

} // namespace bake
