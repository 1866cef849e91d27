// A surface in patches: a mesh as it is, the limit surface of a cage, or an analytic shape.
//
// Patches have the parameters of subdivision.h: quads (0,0) (1,0) (1,1) (0,1), triangles (0,0) (1,0) (0,1).
#pragma once
#include "bake/surface/analytic/parametric.h"
#include "bake/surface/patch/junctions.h"
#include "bake/surface/point/surface_point.h"
#include "bake/surface/subdivision/subdivision.h"

namespace bake {

class BaseSurface {
public:
    /// The mesh itself: triangles flat, quads bilinear, larger polygons as triangulate() splits them; normals and
    /// tangents as MeshSurface interpolates them. Bit-equal positions are one vertex.
    explicit BaseSurface(Mesh mesh);
    /// The limit surface of a cage (call check_cage() first). If any face is not a quad, each quad is four patches, so that
    /// neighbouring patches share whole edges. A note of mesh() counts faces that have no limit surface. Throws
    /// Error{Refusal::unsuitable} with `path` if no face has one, or memory is insufficient.
    BaseSurface(Mesh cage, const SubdivisionOptions& options, const std::string& path = "the cage");
    /// An analytic shape over columns x rows patches.
    BaseSurface(const ParametricSurface& shape, int columns, int rows);
    ~BaseSurface();
    BaseSurface(BaseSurface&&) noexcept;

    const Mesh& mesh() const noexcept; ///< the patches belong to its faces
    const PatchComplex& complex() const noexcept;
    const Junctions& junctions() const noexcept; ///< of complex()

    /// Whether the face of a patch has uvs, at all of its corners. A face that lacks some loses all of them in mesh(); its
    /// edges to faces with uvs are seams.
    bool has_uv(std::uint32_t patch) const noexcept;

    /// The same parameters always give the same bits. The two patches at an edge agree on its points only up to rounding:
    /// a caller that needs equal points evaluates one of the patches.
    void evaluate(std::uint32_t patch, std::span<const Vec2d> st, std::span<SurfacePoint> out) const noexcept;
    /// The lattice (i / rate, j / rate), in rows of equal j, as SubdivisionSurface::evaluate_lattice.
    void evaluate_lattice(std::uint32_t patch, int rate, std::span<SurfacePoint> out) const;

private:
    struct Base;
    std::unique_ptr<Base> base_;
};

} // namespace bake
