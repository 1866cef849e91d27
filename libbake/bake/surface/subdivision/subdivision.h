// Subdivision limit surfaces, computed with OpenSubdiv: point and derivatives at any parameter, in double. The errors are
// below 1e-6 of the diagonal and 0.01 degrees (docs/subdivision.md).
//
// The surface consists of patches with parameters s and t. Under Catmull-Clark a quad of the cage is one patch, and any
// other face of n corners is n patches, one per corner. Under Loop every triangle is one patch.
//
//   quad patch      (s,t) at corners 0 1 2 3: (0,0) (1,0) (1,1) (0,1)
//   triangle        (s,t) at corners 0 1 2:   (0,0) (1,0) (0,1)
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/surface/subdivision/types.h"
#include <memory>
#include <span>
#include <string>

namespace bake {

/// Throws Error{Refusal::unsuitable} with `path`, the first place and a repair for a cage that has no limit surface or that
/// OpenSubdiv would evaluate wrongly: an edge of three faces, a vertex with two fans of faces, a flipped or duplicate face,
/// a face that repeats a position, a crease that is not an edge, and under Loop a face that is not a triangle. Bad indices,
/// faces of two corners and NaN are refused by the readers and asserted here.
void check_cage(const Mesh& cage, Scheme scheme, const std::string& path);

class SubdivisionSurface {
public:
    /// Call check_cage() first. `cage` is not used afterwards. The rule Boundary::none leaves out faces at the border: they
    /// have no patches. Throws Error{Refusal::unsuitable} with `path` if no face is left, or memory is insufficient.
    SubdivisionSurface(const Mesh& cage, const SubdivisionOptions& options = {}, const std::string& path = "the cage");
    ~SubdivisionSurface();
    SubdivisionSurface(SubdivisionSurface&&) noexcept;

    std::uint32_t patches() const noexcept;
    std::uint32_t face(std::uint32_t patch) const noexcept;   ///< face of the cage
    std::uint32_t corner(std::uint32_t patch) const noexcept; ///< corner of that face with (s,t) = (0,0)
    bool has_uv() const noexcept;

    /// One point per parameter. Equal parameters give equal bits.
    void evaluate(std::uint32_t patch, std::span<const Vec2d> st, Derivatives order,
                  std::span<LimitPoint> out) const noexcept;

    /// All points of the lattice (i / rate, j / rate), i varying fastest: (rate + 1)^2 points for a quad patch, the points
    /// with i + j <= rate for a triangle. Faster than evaluate(), with equal bits.
    void evaluate_lattice(std::uint32_t patch, int rate, Derivatives order, std::span<LimitPoint> out) const noexcept;
    /// Only the rows j in [row_begin, row_end) of the lattice.
    void evaluate_rows(std::uint32_t patch, int rate, int row_begin, int row_end, Derivatives order,
                       std::span<LimitPoint> out) const noexcept;

private:
    struct Limit;
    std::unique_ptr<Limit> limit_;
};

} // namespace bake
