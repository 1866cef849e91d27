// Meshes that show a smooth surface: the limit of a cage, or an analytic shape.
#pragma once
#include "bake/surface/patch/base_surface.h"
#include <memory>
#include <string>

namespace bake {

/// The surface itself stays at hand, so that displacement starts from it and not from the mesh's flat faces.
struct SmoothMesh {
    Mesh mesh;
    std::shared_ptr<const BaseSurface> surface; ///< null: the mesh is the surface
};

/// The limit of a cage that was read from `file`, with `segments` quads or triangles along every edge (0: as many as look
/// smooth). Throws Error{Refusal::unsuitable} for a cage without a limit surface. Equal positions of a PLY or glTF cage
/// are one vertex, as in `bake displace --subdivide`.
SmoothMesh limit_mesh(Mesh cage, Scheme scheme, const std::string& file, int segments = 0);

/// The analytic shape that shape_mesh() shows, in as many patches; null for a cube, which is its mesh.
std::shared_ptr<const BaseSurface> shape_surface(const std::string& shape, int columns, int rows);

} // namespace bake
