#include "options.h"

namespace bake {

void add_mesh_options(CLI::App& sub, MeshOptions& options) {
    sub.add_flag("--flip-v", options.flip_v,
                 "Turn the mesh's v over: for files whose v does not run as their format says");
}

} // namespace bake
