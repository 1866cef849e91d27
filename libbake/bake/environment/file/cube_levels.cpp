#include "bake/environment/file/cube_levels.h"
#include "bake/environment/file/face_files.h"
#include "bake/environment/file/radiance.h"
#include "bake/picture/dds.h"
#include "bake/picture/texture_file.h"
#include <algorithm>

namespace bake {

bool names_cube_levels(const std::string& path) { return texture_container(path).has_value(); }

std::vector<Cube> read_cube_levels(const std::string& path) {
    const PictureFile file(path);
    const bool dds = texture_container(path) == TextureContainer::dds;
    std::vector<Cube> cubes;
    for (Image<float>& level : dds ? read_dds_levels(file) : read_ktx2_levels(file)) {
        const int n = level.width();
        if (level.height() != 6 * n)
            throw Error(Refusal::unsuitable, path + ": is no cube map that is read here; give one of RGB9E5, half "
                                                    "floats or unsigned BC6H");
        mend(level, BadPolicy::refuse, path);
        const Image<float> colours = level.channels() == 3 ? std::move(level) : to_rgb(level);
        Cube cube = make_cube(n, 3);
        for (int face = 0; face < 6; ++face)
            std::copy_n(colours.row(face * n), std::size_t(n) * n * 3, cube.faces[std::size_t(face)].data());
        cubes.push_back(std::move(cube));
    }
    return cubes;
}

} // namespace bake
