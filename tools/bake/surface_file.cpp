#include "surface_file.h"
#include "gltf_output.h"

namespace bake {

void write_surface(const SurfaceArgs& args, const SurfaceMesh& surface, std::vector<std::string>& notes) {
    const SurfaceAttributes wanted = args.attributes.value_or(SurfaceAttributes());
    const bool keeps = keeps_file(args.surface, args.out);
    Mesh mesh = surface.kind == SurfaceKind::mesh ? surface.mesh : without_repeats(surface.mesh);
    if (!wanted.tangent || mesh_format(args.out) == MeshFormat::obj) mesh.tangents.clear(); // OBJ has none
    // Tangents are told from the normals, and a limit surface replaces those of its cage.
    if (!wanted.normal && !wanted.tangent && !keeps) mesh.normals.clear(), mesh.corner_normal.clear();
    if (!wanted.curvature)
        std::erase_if(mesh.attributes,
                      [](const Attribute& a) { return a.name == "mean_curvature" || a.name == "gauss_curvature"; });
    GltfCarry carry{.positions = surface.kind != SurfaceKind::mesh || args.surface.weld.has_value(),
                    .normals = wanted.normal,
                    .tangents = wanted.tangent,
                    .same_faces = surface.kind == SurfaceKind::mesh,
                    .facts = {{"content", std::string("surface")}}};
    if (wanted.curvature) carry.attributes = {"mean_curvature", "gauss_curvature"};
    write_result(args.out, args.surface, mesh, carry, notes);
}

} // namespace bake
