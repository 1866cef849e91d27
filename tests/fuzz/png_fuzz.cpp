// PNG. Checksums are set right, as changed chunks would else be refused before anything looks at them.
#include "bake/picture/png.h"
#include "fuzz/picture.h"
#include <vector>

namespace {

std::uint32_t big_endian(const std::uint8_t* at) {
    return std::uint32_t(at[0]) << 24 | std::uint32_t(at[1]) << 16 | std::uint32_t(at[2]) << 8 | at[3];
}

std::uint32_t crc_of(const std::uint8_t* at, std::size_t size) {
    std::uint32_t crc = 0xffffffff;
    for (std::size_t i = 0; i < size; ++i) {
        crc ^= at[i];
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc;
}

void correct_checksums(std::vector<std::uint8_t>& bytes) {
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        const std::size_t size = big_endian(&bytes[at]);
        if (size > bytes.size() - at - 12) return;
        const std::uint32_t crc = crc_of(&bytes[at + 4], size + 4);
        for (std::size_t i = 0; i < 4; ++i) bytes[at + 8 + size + i] = std::uint8_t(crc >> (24 - 8 * i));
        at += size + 12;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::uint8_t> bytes(data, data + size);
    correct_checksums(bytes);
    return bake::fuzz::read_picture(bake::PictureKind::png, bake::read_png, bytes.data(), bytes.size());
}
