// glTF 2.0, .gltf and .glb.
#include "bake/mesh/gltf/io.h"
#include "fuzz/mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bake;
    return fuzz::attempt([&] {
        const fuzz::InputFile input(data, size);
        Gltf gltf = read_gltf(input.path());
        take_texture_uvs(gltf, input.path());
        fuzz::check_mesh(flatten(std::move(gltf)));
    });
}
