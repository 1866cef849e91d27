#include "bake/mesh/check/hausdorff_bound.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/mesh/check/overlay_bound.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr double edge_margin = 1e-3; // cuts closer to a corner than this fraction of the edge leave slivers

/// Sets the square of the bound from the best candidate triangle, which becomes the fourth candidate.
void bound_piece(const TriangleTree& b, Piece& piece) noexcept {
    double best = piece.upper2; // the bound of the whole piece holds for its parts
    bool found = false;
    std::uint32_t best_place = piece.near[3];
    for (int i = 0; i < 4; ++i) {
        if (std::find(piece.near.begin(), piece.near.begin() + i, piece.near[i]) != piece.near.begin() + i) continue;
        double farthest = 0;
        for (int k = 0; k < 3 && farthest < best; ++k)
            farthest = std::max(farthest, b.nearest_of(piece.near[i], piece.p[k]).distance2);
        if (farthest < best || (!found && farthest == best)) best = farthest, best_place = piece.near[i], found = true;
    }
    piece.near[3] = best_place; // a good candidate for the piece is one for its parts
    piece.upper2 = best;
}

/// Positions that two triangles share; returns their number.
int shared(const TriangleTree& b, std::uint32_t s, std::uint32_t t, Vec3d (&out)[3]) noexcept {
    int count = 0;
    for (const Vec3f& p : b.corners(s))
        if (count < 3 && std::find(b.corners(t).begin(), b.corners(t).end(), p) != b.corners(t).end())
            out[count++] = Vec3d(p);
    return count;
}

Vec3d normal(const TriangleTree& b, std::uint32_t place) noexcept {
    const Vec3d p0(b.corners(place)[0]);
    return unit_or_zero(glm::cross(Vec3d(b.corners(place)[1]) - p0, Vec3d(b.corners(place)[2]) - p0));
}

/// Where to cut a piece: at a point inside, or on the edge from corner k + 1 to k + 2.
struct Cut {
    Vec3d at{0};
    int edge = -1; ///< k; -1: inside
    std::uint32_t near = no_index;
};

Cut choose_cut(const TriangleTree& b, const Piece& piece) noexcept {
    Cut cut;
    double most_central = edge_margin;
    double longest = -1;
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const std::uint32_t s = piece.near[i], t = piece.near[j];
        const Vec3d edge = piece.p[j] - piece.p[i];
        if (s == t) continue;
        Vec3d common[3];
        const int count = shared(b, s, t, common);
        for (int v = 0; v < std::min(count, 2); ++v) {
            const NearestPoint foot = nearest_on_triangle(common[v], piece.p[0], piece.p[1], piece.p[2]);
            const double inside = std::min({foot.b1, foot.b2, 1 - foot.b1 - foot.b2});
            if (inside > 0.01) return {foot.point, -1, s};
        }
        if (count == 2) {
            const Vec3d across = glm::cross(common[1] - common[0], normal(b, s) + normal(b, t));
            const double slope = glm::dot(across, edge), at = glm::dot(across, common[0] - piece.p[i]) / slope;
            const double central = std::min(at, 1 - at);
            if (slope != 0 && central > most_central) {
                most_central = central;
                cut = {piece.p[i] + at * edge, k, s};
            }
        }
        // Without such a cut: the midpoint of the longest edge whose ends have different nearest triangles.
        if (most_central == edge_margin && glm::dot(edge, edge) > longest) {
            longest = glm::dot(edge, edge);
            cut = {piece.p[i] + 0.5 * edge, k, s};
        }
    }
    return cut;
}

struct Refined {
    double upper2;
    std::size_t cuts;
    Farthest farthest;
};

/// Cuts the piece with the largest bound until no bound is above the limit. `heap` is a buffer.
Refined refine(const TriangleTree& b, const Piece& whole, double lower2, double gap2, double least2, std::size_t most,
               std::vector<Piece>& heap) {
    const auto less = [](const Piece& x, const Piece& y) { return x.upper2 < y.upper2; };
    heap.assign(1, whole);
    Refined r = {0, 0, {}};
    r.farthest.distance2 = lower2;
    for (;;) {
        throw_if_interrupted(); // a piece may take millions of cuts
        const double limit2 = std::max(gap2 * r.farthest.distance2, least2);
        if (!(heap.front().upper2 > limit2) || r.cuts >= most) break;
        std::pop_heap(heap.begin(), heap.end(), less);
        const Piece piece = heap.back();
        heap.pop_back();
        Cut cut = choose_cut(b, piece);
        ++r.cuts;
        if (cut.near == no_index) { // one triangle is nearest to all corners: the bound is attained
            r.upper2 = std::max(r.upper2, piece.upper2);
            if (heap.empty()) return r;
            continue;
        }
        // The search is only needed if the known triangle is not within the limit.
        if (b.nearest_of(cut.near, cut.at).distance2 > limit2) {
            const NearestPoint found = b.nearest(cut.at, cut.near);
            cut.near = found.triangle;
            r.farthest.include(cut.at, found);
        }
        for (int k = 0; k < 3; ++k) { // the part in which the new point replaces corner k
            if (cut.edge == k) continue;
            Piece part = piece;
            part.p[k] = cut.at;
            part.near[k] = cut.near;
            bound_piece(b, part);
            if (part.upper2 > limit2) {
                heap.push_back(part);
                std::push_heap(heap.begin(), heap.end(), less);
            } else {
                r.upper2 = std::max(r.upper2, part.upper2);
            }
        }
        if (heap.empty()) return r;
    }
    r.upper2 = std::max(r.upper2, heap.front().upper2);
    return r;
}

/// Tests each `stride`-th piece whose bound is above the limit with overlay_within(). Corners of the parts that remain
/// are candidates for the farthest point, which raise the limit.
void overlay(std::vector<Piece>& pieces, const TriangleTree& b, double gap2, double least2, std::int64_t stride,
             Farthest& farthest) {
    constexpr std::int64_t grain = 256;
    const std::int64_t count = (std::int64_t(pieces.size()) + stride - 1) / stride;
    std::vector<Farthest> found((count + grain - 1) / grain, farthest);
    for_rows(count, grain, [&](std::int64_t begin, std::int64_t end) {
        Farthest& own = found[begin / grain];
        OverlayBuffers buffers;
        for (std::int64_t i = begin * stride; i < std::min(end * stride, std::int64_t(pieces.size())); i += stride) {
            const double limit2 = std::max(gap2 * own.distance2, least2);
            if (!(pieces[i].upper2 > limit2)) continue;
            throw_if_interrupted();
            if (overlay_within(b, pieces[i].p, pieces[i].near, limit2, buffers)) {
                pieces[i].upper2 = limit2;
                continue;
            }
            for (std::size_t k = 0; k < std::min<std::size_t>(buffers.open.size(), 8); ++k)
                for (int c = 0; c < buffers.open[k].corners; ++c)
                    own.include(buffers.open[k].p[c], b.nearest(buffers.open[k].p[c], pieces[i].near[3]));
        }
    });
    for (const Farthest& f : found) farthest.include(f);
}

} // namespace

double upper_bound2(std::vector<Piece> pieces, const TriangleTree& other, const BoundOptions& options,
                    Farthest& farthest) {
    for_rows(std::int64_t(pieces.size()), 512, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) bound_piece(other, pieces[i]);
    });
    const double gap2 = (1 + options.gap) * (1 + options.gap), least2 = options.negligible * options.negligible;
    // A few pieces first: they raise the lower bound, which defines the limit of the others.
    for (const int stride : {32, 1, 1}) overlay(pieces, other, gap2, least2, stride, farthest);
    std::size_t left = options.most_cuts;
    double upper2 = 0; // of the pieces that need no more cuts
    // Most pieces need few cuts, a few need many: unfinished pieces start again with eight times as many.
    for (std::size_t round = 32;; round *= 8) {
        const double limit2 = std::max(gap2 * farthest.distance2, least2);
        const auto done =
            std::partition(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.upper2 > limit2; });
        for (auto i = done; i != pieces.end(); ++i) upper2 = std::max(upper2, i->upper2);
        pieces.erase(done, pieces.end());
        const std::size_t most = pieces.empty() ? 0 : std::min(round, left / pieces.size());
        if (most == 0) break;
        std::vector<Refined> refined(pieces.size());
        for_rows(std::int64_t(pieces.size()), 64, [&](std::int64_t begin, std::int64_t end) {
            std::vector<Piece> heap;
            for (std::int64_t i = begin; i < end; ++i)
                refined[i] = refine(other, pieces[i], farthest.distance2, gap2, least2, most, heap);
        });
        std::size_t used = 0;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            pieces[i].upper2 = refined[i].upper2;
            used += refined[i].cuts;
            farthest.include(refined[i].farthest);
        }
        left -= std::min(left, used);
    }
    for (const Piece& p : pieces) upper2 = std::max(upper2, p.upper2);
    return std::max(upper2, farthest.distance2);
}

} // namespace bake
