#include "inputs/tile_names.h"
#include "bake/surface/chart/uv_tiles.h"

namespace bake {
namespace {

const std::string place = "<UDIM>";

} // namespace

bool names_tiles(const std::string& path) { return path.find(place) != std::string::npos; }

std::string file_of_tile(const std::string& path, int tile) {
    std::string out = path;
    for (std::size_t at; (at = out.find(place)) != std::string::npos;)
        out.replace(at, place.size(), std::to_string(tile));
    return out;
}

std::vector<int> udim_tiles(const Mesh& mesh, const std::string& path) {
    if (mesh.corner_uv.empty()) throw Error(Refusal::unsuitable, path + ": has no uvs; unwrap the mesh first");
    constexpr int samples = 64; // for overlaps, which are not asked for
    std::vector<int> out;
    for (const UvTile& tile : uv_tiles(mesh, triangulate(mesh), samples).tiles) {
        if (tile.u < 0 || tile.u > 9 || tile.v < 0 || 1001 + tile.u + 10 * tile.v > 9999)
            throw Error(Refusal::unsuitable, path + ": has charts in tile " + name(tile) +
                                                 " of its uvs, which has no UDIM number; move them into the tiles "
                                                 "from 1001 on");
        out.push_back(1001 + tile.u + 10 * tile.v);
    }
    if (out.empty()) throw Error(Refusal::unsuitable, path + ": no face has area in its uvs; unwrap the mesh");
    return out;
}

void expect_one_file(const std::string& flag, const std::string& path, const std::string& why) {
    if (names_tiles(path))
        throw Error(Refusal::usage, flag + " " + path + ": <UDIM> stands for tiles of a mesh's uvs, and " + why);
}

void expect_tile_or_all(const std::string& what, const std::string& path, int tile) {
    if (tile != 0 && names_tiles(path))
        throw Error(Refusal::usage,
                    "--tile: <UDIM> in the name of " + what + " asks for all tiles; leave one of the two out");
}

} // namespace bake
