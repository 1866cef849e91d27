// The surface that relief stands on, in patches: a mesh as it is, a subdivision limit, or an analytic shape.
//
// Patches have the parameters of subdivision.h: quads (0,0) (1,0) (1,1) (0,1), triangles (0,0) (1,0) (0,1).
#pragma once
#include "bake/surface/parametric.h"
#include "bake/surface/subdivision.h"
#include <array>

namespace bake {

/// The jet runs along two parameters of the surface's own choice (called u and v in Jet): those of the uv chart on
/// meshes, those of the patch on subdivision limits and shapes. How the uv goes along them is beside it, so that nobody
/// divides by the area of a chart: b_s = b_u uv_s.x + b_v uv_s.y, and likewise b_t.
struct SurfacePoint {
    Jet<double> jet;           ///< sigma 0 where there is no normal; then only p holds
    Vec2d uv{0};               ///< zero without uvs
    Vec2d uv_s{0}, uv_t{0};    ///< derivatives of uv along the jet's first and second parameter
};

/// How patches hang together. Two patches share an edge where their faces do; an edge whose ends are one vertex has no
/// length (a pole).
struct PatchComplex {
    struct Patch {
        std::array<std::uint32_t, 4> vertex; ///< at the corners; the fourth no_index on a triangle
        std::array<std::uint32_t, 4> edge;   ///< side i runs from corner i to the next
        std::array<bool, 4> reversed;        ///< the side runs against its edge
        std::uint32_t face;                  ///< of mesh()
        int sides() const noexcept { return vertex[3] == no_index ? 3 : 4; }
    };
    std::vector<Patch> patches;
    std::uint32_t vertices = 0, edges = 0;
    std::vector<bool> seam;   ///< edges: the uvs of its patches differ there
    std::vector<bool> crease; ///< edges: the normals of its patches differ there
};

class BaseSurface {
public:
    /// The mesh itself: triangles flat, quads bilinear, larger polygons as triangulate() splits them; normals and
    /// tangents as MeshSurface interpolates them. Bit-equal positions are one vertex.
    explicit BaseSurface(Mesh mesh);
    /// The limit surface of a cage (check_cage() comes first). Where some face is not a quad, quads are four patches
    /// each, so that patches meet along whole edges.
    BaseSurface(Mesh cage, const SubdivisionOptions& options);
    /// An analytic shape over columns x rows patches.
    BaseSurface(const ParametricSurface& shape, int columns, int rows);
    ~BaseSurface();
    BaseSurface(BaseSurface&&) noexcept;

    const Mesh& mesh() const noexcept; ///< whose faces, groups and materials the patches are of
    const PatchComplex& complex() const noexcept;

    /// Same parameters, same bits, whoever asks. Both patches at an edge agree on its points up to rounding only:
    /// whoever wants them equal asks one of them.
    void evaluate(std::uint32_t patch, std::span<const Vec2d> st, std::span<SurfacePoint> out) const noexcept;
    /// The lattice (i / rate, j / rate), i first, as SubdivisionSurface::evaluate_lattice.
    void evaluate_lattice(std::uint32_t patch, int rate, std::span<SurfacePoint> out) const noexcept;

private:
    struct Base;
    std::unique_ptr<Base> base_;
};

} // namespace bake
