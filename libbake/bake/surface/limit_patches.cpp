// One row of a leaf, b fixed, is a polynomial in a for each of the 30 numbers of a LimitPoint: row_of() works out its
// coefficients once, and each point of the row is one Horner scheme over 30 numbers side by side. Single points go
// through the same two steps, so that they get the same bits.
#include "bake/surface/limit_patches.h"
#include <cassert>
#include <cmath>

namespace bake {
namespace {

constexpr int numbers = 30; // of a LimitPoint: six vectors of 3, six of 2
constexpr int uv_begin = 18;
static_assert(sizeof(LimitPoint) == numbers * sizeof(double));

// Degree is 3 for quads, 4 for triangles.
template <int Degree> struct Row {
    alignas(16) double k[Degree + 1][numbers]; // exponents of a
};

template <int Degree> std::int32_t leaf_at(const LimitPatches& limit, std::int32_t root, double s, double t) noexcept {
    std::int32_t at = root;
    while (at >= 0) {
        const int child = step_into_child(Degree == 4, s, t);
        at = limit.nodes[std::size_t(4 * at + child)];
    }
    return ~at;
}

// Coefficients in a of Size numbers and their derivatives, at k[.][at], k[.][at + Size] and so on.
template <int Degree, int Size>
void collapse(const double* c, double b, double scale, Derivatives order, Row<Degree>& row, int at) noexcept {
    double value[Degree + 3][Size] = {}, first[Degree + 3][Size] = {}, second[Degree + 3][Size] = {};
    for (int m = 0; m <= Degree; ++m) {
        const int top = Degree == 3 ? 3 : 4 - m; // exponent of b
        for (int i = 0; i < Size; ++i) {
            double v = c[top * Size + i], d = 0, dd = 0;
            for (int n = top - 1; n >= 0; --n) {
                dd = dd * b + d;
                d = d * b + v;
                v = v * b + c[n * Size + i];
            }
            value[m][i] = v;
            first[m][i] = d;
            second[m][i] = 2 * dd;
        }
        c += (top + 1) * Size;
    }
    for (int m = 0; m <= Degree; ++m) {
        double* k = row.k[m] + at;
        for (int i = 0; i < Size; ++i) k[i] = value[m][i];
        if (order == Derivatives::none) continue;
        for (int i = 0; i < Size; ++i) {
            k[Size + i] = scale * (m + 1) * value[m + 1][i];
            k[2 * Size + i] = scale * first[m][i];
        }
        if (order == Derivatives::first) continue;
        for (int i = 0; i < Size; ++i) {
            k[3 * Size + i] = scale * scale * ((m + 1) * (m + 2)) * value[m + 2][i];
            k[4 * Size + i] = scale * scale * (m + 1) * first[m + 1][i];
            k[5 * Size + i] = scale * scale * second[m][i];
        }
    }
}

template <int Degree>
void row_of(const LimitPatches& limit, std::int32_t leaf, double b, Derivatives order, Row<Degree>& row) noexcept {
    const std::size_t first = std::size_t(leaf) * std::size_t(limit.terms());
    const double scale = limit.leaves[std::size_t(leaf)].scale;
    collapse<Degree, 3>(&limit.position[first * 3], b, scale, order, row, 0);
    if (limit.has_uv) {
        collapse<Degree, 2>(&limit.uv[first * 2], b, scale, order, row, uv_begin);
        return;
    }
    for (auto& k : row.k)
        for (int i = uv_begin; i < numbers; ++i) k[i] = 0;
}

template <int Degree, int Begin, int End> void horner(const Row<Degree>& row, double a, double* out) noexcept {
    for (int i = Begin; i < End; ++i) {
        double value = row.k[Degree][i];
        for (int m = Degree - 1; m >= 0; --m) value = value * a + row.k[m][i];
        out[i] = value;
    }
}

template <int Degree> void point_of(const Row<Degree>& row, double a, Derivatives order, LimitPoint& point) noexcept {
    double* out = &point.p.x;
    switch (order) {
    case Derivatives::none:
        horner<Degree, 0, 3>(row, a, out);
        horner<Degree, uv_begin, uv_begin + 2>(row, a, out);
        break;
    case Derivatives::first:
        horner<Degree, 0, 9>(row, a, out);
        horner<Degree, uv_begin, uv_begin + 6>(row, a, out);
        break;
    case Derivatives::second: horner<Degree, 0, numbers>(row, a, out); break;
    }
}

template <int Degree>
void evaluate_points(const LimitPatches& limit, std::uint32_t patch, std::span<const Vec2d> st, Derivatives order,
                     std::span<LimitPoint> out) noexcept {
    const std::int32_t root = limit.patches[patch].root;
    Row<Degree> row;
    std::int32_t row_leaf = -1;
    double row_b = 0;
    for (std::size_t i = 0; i < st.size(); ++i) {
        const double s = st[i].x, t = st[i].y;
        const std::int32_t index = leaf_at<Degree>(limit, root, s, t);
        const LimitLeaf& leaf = limit.leaves[std::size_t(index)];
        const double b = t * leaf.scale + leaf.origin.y;
        if (index != row_leaf || b != row_b) row_of<Degree>(limit, index, b, order, row);
        row_leaf = index;
        row_b = b;
        point_of<Degree>(row, s * leaf.scale + leaf.origin.x, order, out[i]);
    }
}

template <int Degree>
void evaluate_lattice_rows(const LimitPatches& limit, std::uint32_t patch, int rate, int row_begin, int row_end,
                           Derivatives order, LimitPoint* out) noexcept {
    const std::int32_t root = limit.patches[patch].root;
    const double steps = rate;
    Row<Degree> row;
    for (int j = row_begin; j < row_end; ++j) {
        const double t = j / steps;
        const int last = Degree == 3 ? rate : rate - j;
        const auto leaf_of = [&](int i) { return leaf_at<Degree>(limit, root, i / steps, t); };
        for (int i = 0; i <= last;) {
            const std::int32_t index = leaf_of(i);
            const LimitLeaf& leaf = limit.leaves[std::size_t(index)];
            const double b = t * leaf.scale + leaf.origin.y;
            // Where the leaf ends, by its far side; rounding may put a point on that side to either leaf.
            const double end_a = leaf.scale < 0 ? 0 : Degree == 3 ? 1 : 1 - b;
            const double guess = (end_a - leaf.origin.x) / leaf.scale * steps;
            int end = std::min(std::max(int(guess), i + 1), last + 1);
            while (end > i + 1 && leaf_of(end - 1) != index) --end;
            while (end <= last && leaf_of(end) == index) ++end;
            row_of<Degree>(limit, index, b, order, row);
            for (; i < end; ++i) point_of<Degree>(row, (i / steps) * leaf.scale + leaf.origin.x, order, *out++);
        }
    }
}

} // namespace

void evaluate(const LimitPatches& limit, std::uint32_t patch, std::span<const Vec2d> st, Derivatives order,
              std::span<LimitPoint> out) noexcept {
    assert(patch < limit.patches.size() && out.size() >= st.size());
    if (limit.triangles)
        evaluate_points<4>(limit, patch, st, order, out);
    else
        evaluate_points<3>(limit, patch, st, order, out);
}

void evaluate_rows(const LimitPatches& limit, std::uint32_t patch, int rate, int row_begin, int row_end, Derivatives order,
                   std::span<LimitPoint> out) noexcept {
    assert(patch < limit.patches.size() && rate > 0 && row_begin >= 0 && row_end <= rate + 1);
    if (limit.triangles)
        evaluate_lattice_rows<4>(limit, patch, rate, row_begin, row_end, order, out.data());
    else
        evaluate_lattice_rows<3>(limit, patch, rate, row_begin, row_end, order, out.data());
}

} // namespace bake
