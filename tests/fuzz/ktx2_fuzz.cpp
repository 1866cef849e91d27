// KTX2.
#include "bake/picture/dds.h"
#include "fuzz/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return bake::fuzz::read_picture(bake::PictureKind::ktx2, bake::read_ktx2, data, size);
}
