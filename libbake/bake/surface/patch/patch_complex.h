// Connectivity of the patches of a surface: numbered vertices and edges.
#pragma once
#include "bake/mesh/mesh.h"
#include <array>
#include <functional>

namespace bake {

/// Patches share an edge where their faces do. An edge whose ends are the same vertex has no length (a pole) and belongs to
/// one side of one patch. Other edges have one patch (a boundary), two, or more.
struct PatchComplex {
    struct Patch {
        std::array<std::uint32_t, 4> vertex; ///< at the corners; the fourth is no_index on a triangle
        std::array<std::uint32_t, 4>
            edge;                     ///< side i goes from corner i to the next; the fourth is no_index on a triangle
        std::array<bool, 4> reversed; ///< the side has the opposite direction of its edge
        std::uint32_t face;           ///< face of the mesh
        int sides() const noexcept { return vertex[3] == no_index ? 3 : 4; }
    };
    std::vector<Patch> patches;
    std::uint32_t vertices = 0, edges = 0;
    std::vector<bool> seam;   ///< edges: the uvs of the edge's patches differ
    std::vector<bool> crease; ///< edges: the normals of the edge's patches differ by more than 0.001
    std::vector<bool>
        sharp_vertex; ///< vertices: the normals of the vertex's patches differ (the end of a crease, a tip)
};

/// Values of a patch at a point of its border: unit normal (zero: none) and uv (infinite: none).
struct RimValue {
    Vec3f n;
    Vec2d uv;
};

/// The complex of patches whose vertices and faces are set; vertices are renumbered in order of first use. An edge goes from
/// its lower vertex to its higher one. rim(patch, k) is the value at corner k of a patch and, if `middles` is set, at the
/// middle of side k - 4. uvs differ if they are more than `uv_tolerance` apart.
PatchComplex make_complex(std::vector<PatchComplex::Patch> patches,
                          const std::function<RimValue(std::uint32_t, int)>& rim, bool middles, double uv_tolerance);

} // namespace bake
