#include "bake/environment/file/sky_cube.h"
#include "bake/environment/file/face_files.h"
#include "bake/environment/resample/resample.h"

namespace bake {

Cube sky_cube(Environment sky) {
    if (!sky.is_cube() || sky.edge_samples) sky.cube = to_cube(sky, {sky.face_edge(), false}, {Samples::one});
    for (Image<float>& face : sky.cube.faces)
        if (face.channels() != 3) face = to_rgb(face);
    return std::move(sky.cube);
}

} // namespace bake
