// PLY, as text and in both byte orders.
#include "bake/mesh/file/ply.h"
#include "fuzz/mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bake;
    return fuzz::attempt([&] {
        const fuzz::InputFile input(data, size);
        fuzz::check_mesh(read_ply(input.path()));
    });
}
