// How the patches of a surface hang together: vertices and edges, each numbered once.
#pragma once
#include "bake/mesh/mesh.h"
#include <array>
#include <functional>

namespace bake {

/// Two patches share an edge where their faces do; an edge whose ends are one vertex has no length (a pole) and belongs
/// to one side of one patch. An edge may have one patch (a boundary), two, or more.
struct PatchComplex {
    struct Patch {
        std::array<std::uint32_t, 4> vertex; ///< at the corners; the fourth no_index on a triangle
        std::array<std::uint32_t, 4> edge; ///< side i runs from corner i to the next; the fourth no_index on a triangle
        std::array<bool, 4> reversed;      ///< the side runs against its edge
        std::uint32_t face;                ///< of the mesh they are of
        int sides() const noexcept { return vertex[3] == no_index ? 3 : 4; }
    };
    std::vector<Patch> patches;
    std::uint32_t vertices = 0, edges = 0;
    std::vector<bool> seam;         ///< edges: the uvs of its patches differ there
    std::vector<bool> crease;       ///< edges: the normals of its patches differ there, by more than 0.001
    std::vector<bool> sharp_vertex; ///< vertices: the normals of its patches differ there (the end of a crease, a tip)
};

/// What a patch says at a place of its rim: unit normal (zero: none) and uv (infinite: none).
struct RimValue {
    Vec3f n;
    Vec2d uv;
};

/// The whole complex of patches whose vertices and faces are set; vertices are numbered anew, in order of first use.
/// `rim` gives the value at corner k of a patch, and at the middle of side k - 4 where `middles` is set. uvs differ when
/// they are more than `uv_tolerance` apart.
PatchComplex make_complex(std::vector<PatchComplex::Patch> patches,
                          const std::function<RimValue(std::uint32_t, int)>& rim, bool middles, double uv_tolerance);

} // namespace bake
