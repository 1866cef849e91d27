// BMP of 16 and 32 bits.
#include "bake/picture/bmp.h"
#include "fuzz/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return bake::fuzz::read_picture(bake::PictureKind::bmp, bake::read_masked_bmp, data, size);
}
