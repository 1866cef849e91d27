// How far a tessellation lies from the displaced surface.
//
// Every face is compared with the surface at parameters denser than its corners: at least its middles, and one per texel
// of the height. The distance is that of a point of the surface from the face that stands for it there, split along
// whichever diagonal is worse: an upper bound of its distance from the mesh. Each side of a seam is compared with itself.
#pragma once
#include "bake/relief/displace/layout.h"
#include "bake/relief/displace/seam_blend.h"

namespace bake {

/// The displaced surface of one patch: its points at parameters, with the correction of a blend.
class DisplacedPatch {
public:
    DisplacedPatch(const ReliefSurface& surface, const SeamBlend& blend) : surface_(&surface), blend_(&blend) {}
    /// One point per parameter. uvs follow in uv() until the next call.
    std::span<const Vec3d> points(std::uint32_t patch, std::span<const Vec2d> st);
    std::span<const SurfacePoint> base() const noexcept { return base_; }
    const ReliefSurface& surface() const noexcept { return *surface_; }

private:
    const ReliefSurface* surface_;
    const SeamBlend* blend_;
    std::vector<SurfacePoint> base_;
    std::vector<ReliefValue> values_;
    std::vector<Vec3d> points_;
};

/// The ring of a cell's lattice in numbers of its own.
struct CellRing {
    std::array<std::vector<FaceCorner>, 4> side;
    PatchRing ring; ///< views of side

    /// Numbers the lattice's points from 0, the border around and then inside, and calls put(place on the patch, place in the
    /// cell) for each. The first number inside.
    template <class Put>
    std::uint32_t number(const PatchCells& cells, std::uint32_t cell, const PatchRates& r, const Put& put) {
        static constexpr Vec2d square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle[] = {{0, 0}, {1, 0}, {0, 1}};
        const Vec2d* const corner = r.sides == 4 ? square : triangle;
        std::uint32_t next = 0;
        for (int i = 0; i < r.sides; ++i) {
            side[i].clear();
            for (std::uint32_t k = 0; k < r.side[i]; ++k, ++next) {
                put(cells.on_side(cell, i, k, r.side[i]),
                    glm::mix(corner[i], corner[(i + 1) % r.sides], double(k) / r.side[i]));
                side[i].push_back({next, next, next});
            }
        }
        for (int i = 0; i < r.sides; ++i) {
            side[i].push_back(side[(i + 1) % r.sides].front());
            ring.side[i] = side[i];
        }
        if (inner_points(r) == 0) return next;
        const std::uint32_t n = r.sides == 4 ? r.up : r.across;
        for (std::uint32_t j = 1; j < n; ++j)
            for (std::uint32_t i = 1; i < (r.sides == 4 ? r.across : r.across - j); ++i)
                put(cells.at(cell, i, r.across, j, n), Vec2d(double(i) / r.across, double(j) / n));
        return next;
    }
};

struct CellError {
    double inside = 0; ///< largest distance from faces all of whose corners are inside the cell
    double border = 0; ///< from those with a corner on its border
    double square_sum = 0;
    std::uint64_t samples = 0;
    double max() const noexcept { return std::max(inside, border); }
};

/// Of one cell at fitted rates. Stops early, with what it has found, once `enough` is exceeded.
CellError cell_error(DisplacedPatch& patch, const PatchCells& cells, std::uint32_t cell, const PatchRates& rates,
                     double enough);

double distance_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) noexcept;
/// Distance of a point from a triangle, of no area too. Ericson, Real-Time Collision Detection, 2005, 5.1.5.
double distance_to_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) noexcept;

} // namespace bake
