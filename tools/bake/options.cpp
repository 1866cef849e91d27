#include "options.h"

namespace bake {

void add_mesh_options(CLI::App& sub, MeshOptions& options) {
    sub.add_flag("--flip-v", options.flip_v,
                 "Turn the mesh's v over: for files whose v does not run as their format says");
    add_integer_option(sub, "--uv-set", options.uv_set, 0, 99,
                       "Set of uvs of the mesh (TEXCOORD_N) [glTF: that of its normal texture; else 0]");
}

void add_tile_option(CLI::App& sub, int& tile) {
    add_integer_option(sub, "--tile", tile, 1001, 9999,
                       "UDIM tile whose charts are taken [all charts, modulo 1, if they do not overlap]");
}

void note_all(const CommonArgs& common, const std::string& path, const std::vector<std::string>& notes) {
    for (const std::string& line : notes) note(common, path + ": " + line);
}

} // namespace bake
