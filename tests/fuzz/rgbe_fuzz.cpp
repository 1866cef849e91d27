// Radiance pictures.
#include "bake/picture/rgbe.h"
#include "fuzz/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return bake::fuzz::read_picture(bake::PictureKind::hdr, bake::read_rgbe, data, size);
}
