// The texels of one row of a normal map on a mesh.
//
// The row is worked on in blocks. Neighbouring texels in one triangle form a run: what varies linearly over the triangle
// is evaluated for the whole run at the texels' own barycentrics, so that nothing accumulates along it. Then one loop
// without branches computes the normals of the block:
//
//   m               interpolated normal, L its length, n = m / L; m_u, m_v are its derivatives, constant in a triangle
//   P_u, P_v        interpolated derivatives of the surface; jet_at() makes them perpendicular to n
//   W_u, W_v        P_u + c m_u, P_v + c m_v, with c = b / L for exact, and c = 0 for blinn and surface_gradient
//   D               b_u W_v - b_v W_u
//
// Vectors along n drop out of all products with n, so that nothing has to be made perpendicular to n:
//   N' ~ sigma (A / L m + m x D),  A = m . (W_u x W_v)
// Its coordinates in the frame T, sign (m x T), m follow from (m x D) . (m x T) = L^2 D.T - (D.m)(m.T).
// constant_scale fits the same form with A = L and another D. Texels that fold, that are degenerate or that leave the
// range of float are left to the functions of displaced_normal.h, one texel at a time.
#pragma once
#include "bake/relief/map/bake_target.h"
#include <memory>

namespace bake {

/// Texels of the rows baked so far.
struct TexelCounts {
    std::int64_t degenerate = 0, folded = 0; ///< as NormalMapReport
};

/// Bakes rows; one object per thread. Both arguments must outlive it.
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
    /// One texel that the loop has no result for.
    void bake_special(const TexelHit& hit, const Height<float>& height, float* rgb, unsigned char& owned);

    const BakeTarget& target_;
    const NormalMapOptions& options_;
    TexelCounts counts_;
    std::unique_ptr<Room> room_;
};

} // namespace bake
