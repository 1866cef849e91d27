// OBJ, and the encodings and line ends of text.
#include "bake/mesh/file/obj.h"
#include "fuzz/mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bake;
    return fuzz::attempt([&] {
        const fuzz::InputFile input(data, size);
        fuzz::check_mesh(read_obj(input.path()));
    });
}
