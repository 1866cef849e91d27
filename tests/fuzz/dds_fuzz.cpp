// DDS of wide channels.
#include "bake/picture/dds.h"
#include "fuzz/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return bake::fuzz::read_picture(bake::is_wide_dds, bake::read_wide_dds, data, size);
}
