// Scenes (TOML). The files that they name are not read.
#include "bake/preview/scene_io.h"
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bake;
    return fuzz::attempt([&] {
        const fuzz::InputFile input(data, size);
        const SceneEntries scene = read_scene(input.path());
        for (const MeshEntry& mesh : scene.meshes)
            fuzz::require(mesh.material >= -1 && mesh.material < int(scene.materials.size()), "materials are in range");
    });
}
