// DDS without compression.
#include "bake/picture/dds.h"
#include "fuzz/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return bake::fuzz::read_picture(bake::PictureKind::dds, bake::read_dds, data, size);
}
