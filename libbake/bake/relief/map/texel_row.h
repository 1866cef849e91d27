// The texels of one row of a normal map on a mesh.
//
// The row is processed in blocks. Neighbouring texels in one triangle form a run. Values that are linear over the
// triangle are evaluated at the barycentrics of each texel of the run, so that no error accumulates along it. Then one
// loop without branches computes the normals of the block:
//
//   m               interpolated normal, L its length, n = m / L; m_u, m_v are its derivatives, constant in a triangle
//   P_u, P_v        interpolated derivatives of the surface; jet_at() makes them perpendicular to n
//   W_u, W_v        P_u + c m_u, P_v + c m_v, with c = b / L for exact, and c = 0 for blinn and surface_gradient
//   D               b_u W_v - b_v W_u
//
// Components along n cancel in all products with n, so that no vector has to be made perpendicular to n:
//   N' ~ sigma (A / L m + m x D),  A = m . (W_u x W_v)
// Its coordinates in the frame T, sign (m x T), m follow from (m x D) . (m x T) = L^2 D.T - (D.m)(m.T). constant_scale
// has the same form with A = L and another D. Texels that fold, are degenerate or exceed the range of float are
// computed one at a time by the functions of displaced_normal.h.
#pragma once
#include "bake/relief/map/bake_target.h"
#include <memory>

namespace bake {

/// Counts over the rows baked so far.
struct TexelCounts {
    std::int64_t degenerate = 0, folded = 0; ///< as NormalMapReport
};

/// Bakes rows; one object per thread. The arguments of the constructor must outlive the object.
class TexelRow {
public:
    TexelRow(const BakeTarget& target, const NormalMapOptions& options);
    ~TexelRow();
    TexelRow(const TexelRow&) = delete;
    TexelRow& operator=(const TexelRow&) = delete;

    /// Writes three encoded channels per texel of row y, and to `owned` whether the texel has a normal of its own; the
    /// others are flat. `heights` has one value per texel.
    void bake(int y, const Height<float>* heights, float* rgb, unsigned char* owned);
    const TexelCounts& counts() const noexcept { return counts_; }

private:
    struct Room;
    /// Bakes one texel that the loop cannot compute.
    void bake_special(const TexelHit& hit, const Height<float>& height, float* rgb, unsigned char& owned);

    const BakeTarget& target_;
    const NormalMapOptions& options_;
    TexelCounts counts_;
    std::unique_ptr<Room> room_;
};

} // namespace bake
