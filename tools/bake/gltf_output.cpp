#include "gltf_output.h"

namespace bake {

bool keeps_file(const SurfaceInput& input, const std::string& out) {
    return input.shape.empty() && mesh_format(input.mesh) == MeshFormat::gltf && mesh_format(out) == MeshFormat::gltf;
}

std::int64_t write_result(const std::string& out, const SurfaceInput& input, const Mesh& mesh, GltfCarry carry,
                          std::vector<std::string>& notes) {
    if (!keeps_file(input, out)) return write_mesh(out, mesh, carry.facts);
    carry.uv_set = input.reading.uv_set, carry.flip_v = !input.reading.flip_v;
    GltfCarried done = carry_gltf(out, input.mesh, mesh, carry);
    notes.insert(notes.end(), done.notes.begin(), done.notes.end());
    return done.bytes;
}

} // namespace bake
