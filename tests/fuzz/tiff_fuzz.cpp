// TIFF.
#include "bake/picture/tiff.h"
#include "fuzz/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return bake::fuzz::read_picture(bake::PictureKind::tiff, bake::read_tiff, data, size);
}
