// Subdivision limit surfaces, through OpenSubdiv: point and derivatives at any parameter, in double.
//
// The surface comes in patches with their own parameters s and t: under Catmull-Clark a quad of the cage is one patch
// and any other face of n corners is n of them, one per corner; under Loop every triangle is one.
//
//   quad patch      (0,0) (1,0) (1,1) (0,1)  at its corners 0 1 2 3
//   triangle        (0,0) (1,0) (0,1)        at its corners 0 1 2
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/surface/point/jet.h"
#include "bake/surface/subdivision/types.h"
#include <memory>
#include <span>
#include <string>

namespace bake {

/// Throws Error{Refusal::unsuitable} (naming `path`, the first place and the mend) for a cage that has no limit surface
/// or that OpenSubdiv would accept and get wrong: an edge of three faces, a vertex where faces meet in two fans, a
/// flipped or duplicate face, a face that repeats a position, a crease that is no edge; Loop: a face that is not a
/// triangle. Bad indices, 2-gons and NaN are refused by the readers, and asserted here.
void check_cage(const Mesh& cage, Scheme scheme, const std::string& path);

class SubdivisionSurface {
public:
    /// check_cage() comes first. `cage` may go afterwards. Throws Error{Refusal::unsuitable} when it needs more memory
    /// than there is.
    SubdivisionSurface(const Mesh& cage, const SubdivisionOptions& options = {});
    ~SubdivisionSurface();
    SubdivisionSurface(SubdivisionSurface&&) noexcept;

    std::uint32_t patches() const noexcept;
    std::uint32_t face(std::uint32_t patch) const noexcept;   ///< of the cage
    std::uint32_t corner(std::uint32_t patch) const noexcept; ///< of that face, 0 for whole faces: where (0,0) lies
    bool has_uv() const noexcept;

    /// One point per parameter. Same parameters, same bits, whoever asks.
    void evaluate(std::uint32_t patch, std::span<const Vec2d> st, Derivatives order,
                  std::span<LimitPoint> out) const noexcept;

    /// All points of the lattice (i / rate, j / rate), i first: (rate + 1)^2 for a quad patch, those with i + j <= rate
    /// for a triangle. The same bits as evaluate() gives, faster.
    void evaluate_lattice(std::uint32_t patch, int rate, Derivatives order, std::span<LimitPoint> out) const noexcept;
    /// Its rows j in [row_begin, row_end) only, for callers who work in bands.
    void evaluate_rows(std::uint32_t patch, int rate, int row_begin, int row_end, Derivatives order,
                       std::span<LimitPoint> out) const noexcept;

private:
    struct Limit;
    std::unique_ptr<Limit> limit_;
};

/// The cage after so many levels of subdivision, at most 15: not yet the limit. Uvs, materials, groups and tags are kept
/// (tags as sharp as the levels leave them, so that refining goes on as if in one go), normals and attributes are not.
/// check_cage() comes first. Throws Error{Refusal::unsuitable} when it needs more memory than there is.
Mesh refine(const Mesh& cage, const SubdivisionOptions& options, int levels);

/// Derivatives along the UV chart instead of the patch's own parameters; needs Derivatives::second. All derivatives
/// zero where the chart has no area.
Jet2<double> chart_derivatives(const LimitPoint& point) noexcept;
/// The same as a jet: n is along p_s x p_t (zero where that vanishes), sigma -1 on mirrored charts; sigma, p_u, p_v,
/// n_u, n_v zero where the chart has no area.
Jet<double> chart_jet(const LimitPoint& point) noexcept;

} // namespace bake
