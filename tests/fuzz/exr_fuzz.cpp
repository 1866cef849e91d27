// OpenEXR.
#include "bake/picture/exr.h"
#include "fuzz/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return bake::fuzz::read_picture(bake::PictureKind::exr, bake::read_exr, data, size);
}
