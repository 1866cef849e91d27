// Khronos, "KTX File Format Specification" 2.0; "Khronos Data Format Specification" 1.3, basic descriptor block.
#include "bake/picture/ktx2_writer.h"
#include "bake/base/version.h"
#include <numeric>

namespace bake {
namespace {

/// What the file says of its texels.
struct Texels {
    std::uint32_t vulkan;      ///< VkFormat
    std::uint32_t sample_type; ///< bytes that are swapped where the byte order differs
    std::uint32_t block_side, block_bytes;
    std::uint32_t colour_model;
    std::vector<std::uint32_t> channels; ///< KHR_DF_CHANNEL, with its qualifiers in the higher bits
    bool floats = false;                 ///< what stands for 0 and 1 is given as floats
};

constexpr std::uint32_t is_exponent = 0x20, is_signed = 0x40, is_float = 0x80; // qualifiers

Texels texels_of(TexelFormat format) {
    constexpr std::uint32_t rgb_model = 1, bc5_model = 132, bc6h_model = 133, red = 0, green = 1, blue = 2, alpha = 15;
    switch (format) {
    case TexelFormat::r8: return {9, 1, 1, 1, rgb_model, {red}};
    case TexelFormat::rgba8: return {37, 1, 1, 4, rgb_model, {red, green, blue, alpha}};
    case TexelFormat::rgba16: return {91, 2, 1, 8, rgb_model, {red, green, blue, alpha}};
    case TexelFormat::rgb9e5:
        return {123, 4,         1,
                4,   rgb_model, {red, red | is_exponent, green, green | is_exponent, blue, blue | is_exponent}};
    case TexelFormat::rgba16f: {
        const std::uint32_t half = is_float | is_signed;
        return {97, 2, 1, 8, rgb_model, {red | half, green | half, blue | half, alpha | half}, true};
    }
    case TexelFormat::rg16f:
        return {83, 2, 1, 4, rgb_model, {red | is_float | is_signed, green | is_float | is_signed}, true};
    case TexelFormat::bc6h: return {143, 1, 4, 16, bc6h_model, {red | is_float}, true};
    case TexelFormat::bc5: break;
    }
    return {141, 1, 4, 16, bc5_model, {red, green}};
}

/// Little endian; bytes beyond the eighth are 0.
void append(std::string& to, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to += i < 8 ? char(value >> 8 * i) : char(0);
}

void pad(std::string& to, std::size_t alignment) { to.resize((to.size() + alignment - 1) / alignment * alignment); }

/// Where a channel lies in the texel or block, and which of its values stand for 0 and for 1; of halves for -1 and 1.
void append_sample(std::string& out, const Texels& texels, std::uint32_t i) {
    constexpr std::uint32_t one = 0x3f800000, minus_one = 0xbf800000; // as floats
    const bool shared = texels.channels.back() & is_exponent;
    const std::uint32_t channel = texels.channels[i],
                        even = std::uint32_t(8 * texels.block_bytes / texels.channels.size());
    const std::uint32_t first = !shared ? i * even : channel & is_exponent ? 27 : i / 2 * 9;
    const std::uint32_t bits = !shared ? even : channel & is_exponent ? 5 : 9;
    std::uint32_t zero_at = 0, one_at = texels.block_side > 1 ? 0xffffffffu : (std::uint32_t(1) << bits % 32) - 1;
    if (texels.floats) zero_at = channel & is_signed ? minus_one : 0, one_at = one;
    // A shared exponent is biased by 15, and its mantissa of 9 bits is 256 for 1.
    if (shared) zero_at = channel & is_exponent ? 15 : 0, one_at = channel & is_exponent ? 31 : 256;
    append(out, first | std::uint64_t(bits - 1) << 16 | std::uint64_t(channel) << 24, 4);
    append(out, 0, 4); // position of the sample
    append(out, zero_at, 4);
    append(out, one_at, 4);
}

std::string data_format_descriptor(const Texels& texels) {
    constexpr std::uint32_t version = 2, unspecified_primaries = 0, linear = 1;
    const std::size_t samples = texels.channels.size(), block_size = 24 + 16 * samples;
    std::string out;
    append(out, 4 + block_size, 4);
    append(out, 0, 4); // vendor Khronos, type basic
    append(out, version | std::uint64_t(block_size) << 16, 4);
    append(out, texels.colour_model | unspecified_primaries << 8 | linear << 16, 4);
    append(out, texels.block_side - 1, 1), append(out, texels.block_side - 1, 1), append(out, 0, 2);
    append(out, texels.block_bytes, 1), append(out, 0, 7); // one plane
    for (std::uint32_t i = 0; i < samples; ++i) append_sample(out, texels, i);
    return out;
}

std::string key_values(const std::string& record) {
    const auto append_pair = [](std::string& to, const std::string& key, const std::string& value) {
        append(to, key.size() + value.size() + 2, 4);
        to += key + '\0' + value + '\0';
        pad(to, 4);
    };
    std::string out;
    append_pair(out, "KTXorientation", "rd"); // rows from the top down
    append_pair(out, "KTXwriter", std::string("bake ") + version());
    if (!record.empty()) append_pair(out, record_key, record);
    return out;
}

} // namespace

void write_ktx2(BlockWriter& out, TexelFormat format, const std::vector<TextureLevel>& levels, int faces,
                const Facts& facts) {
    const Texels texels = texels_of(format);
    const std::string descriptor = data_format_descriptor(texels), pairs = key_values(record_text(facts));
    const std::size_t index_at = 80, descriptor_at = index_at + 24 * levels.size(),
                      pairs_at = descriptor_at + descriptor.size();
    const auto alignment = std::size_t(std::lcm(texels.block_bytes, 4u));
    std::string head("\xabKTX 20\xbb\r\n\x1a\n", 12);
    for (const std::uint32_t word :
         {texels.vulkan, texels.sample_type, std::uint32_t(levels[0].width), std::uint32_t(levels[0].height),
          0u, // no depth
          0u, // no array
          std::uint32_t(faces), std::uint32_t(levels.size()),
          0u, // not supercompressed
          std::uint32_t(descriptor_at), std::uint32_t(descriptor.size()), std::uint32_t(pairs_at),
          std::uint32_t(pairs.size())})
        append(head, word, 4);
    append(head, 0, 16); // no data of a supercompression
    std::vector<std::size_t> places(levels.size());
    std::size_t end = pairs_at + pairs.size();
    for (std::size_t k = levels.size(); k-- > 0;) {
        places[k] = (end + alignment - 1) / alignment * alignment;
        end = places[k] + levels[k].bytes.size();
    }
    for (std::size_t k = 0; k < levels.size(); ++k) {
        append(head, places[k], 8);
        append(head, levels[k].bytes.size(), 8);
        append(head, levels[k].bytes.size(), 8);
    }
    out.write(head + descriptor + pairs);
    for (std::size_t k = levels.size(); k-- > 0;) {
        out.write(std::string(places[k] - std::size_t(out.bytes()), '\0'));
        out.write(levels[k].bytes);
    }
}

} // namespace bake
