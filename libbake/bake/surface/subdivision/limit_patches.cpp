// For fixed b each of the 30 numbers of a LimitPoint is a polynomial in a. row_of() computes its coefficients once per row;
// each point of the row is one Horner scheme over 30 numbers, which the compiler vectorises. Single points use the same two
// steps and have the same bits.
#include "bake/surface/subdivision/limit_patches.h"
#include <cassert>
#include <cmath>
#include <type_traits>

namespace bake {
namespace {

constexpr int numbers = 30; // in a LimitPoint: six vectors of 3 and six of 2
constexpr int uv_begin = 18;
static_assert(sizeof(LimitPoint) == numbers * sizeof(double));

// Degree is 3 for quads, 4 for triangles.
template <int Degree> struct Row {
    alignas(16) double k[Degree + 1][numbers]; // by exponent of a
};

template <int Degree> std::int32_t leaf_at(const LimitPatches& limit, std::int32_t root, double s, double t) noexcept {
    std::int32_t at = root;
    while (at >= 0) {
        const int child = step_into_child(Degree == 4, s, t);
        at = limit.nodes[std::size_t(4 * at + child)];
    }
    return ~at;
}

// Coefficients in a of Size numbers (at k[.][at]) and of their derivatives (at k[.][at + Size] and so on).
template <int Degree, int Size, Derivatives Order>
void collapse(const double* c, double b, double scale, Row<Degree>& row, int at) noexcept {
    constexpr bool firsts = Order != Derivatives::none, seconds = Order == Derivatives::second;
    constexpr int width = (Degree + 3) * Size; // two exponents of a are zero padding for the derivatives
    double value[width] = {}, first[width] = {}, second[width] = {};
    // Horner scheme in b for all exponents of a. In a triangle a higher exponent of b has fewer exponents of a.
    const double* end = c + (Degree == 3 ? 16 : 15) * Size;
    for (int n = Degree; n >= 0; --n) {
        const int count = (Degree == 3 ? 4 : 5 - n) * Size;
        end -= count;
        for (int i = 0; i < count; ++i) {
            if constexpr (seconds) second[i] = second[i] * b + first[i];
            if constexpr (firsts) first[i] = first[i] * b + value[i];
            value[i] = value[i] * b + end[i];
        }
    }
    for (int m = 0; m <= Degree; ++m) {
        double* k = row.k[m] + at;
        const double *v = value + m * Size, *d = first + m * Size, *dd = second + m * Size;
        for (int i = 0; i < Size; ++i) k[i] = v[i];
        if constexpr (firsts)
            for (int i = 0; i < Size; ++i) {
                k[Size + i] = scale * (m + 1) * v[Size + i];
                k[2 * Size + i] = scale * d[i];
            }
        if constexpr (seconds)
            for (int i = 0; i < Size; ++i) {
                k[3 * Size + i] = scale * scale * ((m + 1) * (m + 2)) * v[2 * Size + i];
                k[4 * Size + i] = scale * scale * (m + 1) * d[Size + i];
                k[5 * Size + i] = 2 * scale * scale * dd[i];
            }
    }
}

template <int Degree, Derivatives Order, bool Uv>
void row_of(const LimitPatches& limit, std::int32_t leaf, double b, Row<Degree>& row) noexcept {
    const std::size_t first = std::size_t(leaf) * std::size_t(limit.terms());
    const double scale = limit.leaves[std::size_t(leaf)].scale;
    collapse<Degree, 3, Order>(&limit.position[first * 3], b, scale, row, 0);
    if constexpr (Uv) collapse<Degree, 2, Order>(&limit.uv[first * 2], b, scale, row, uv_begin);
}

template <int Degree, int Begin, int End> void horner(const Row<Degree>& row, double a, double* out) noexcept {
    for (int i = Begin; i < End; ++i) {
        double value = row.k[Degree][i];
        for (int m = Degree - 1; m >= 0; --m) value = value * a + row.k[m][i];
        out[i] = value;
    }
}

template <int Degree, Derivatives Order, bool Uv>
void point_of(const Row<Degree>& row, double a, LimitPoint& point) noexcept {
    constexpr int vectors = Order == Derivatives::none ? 1 : Order == Derivatives::first ? 3 : 6;
    double* out = &point.p.x;
    if constexpr (Uv && Order == Derivatives::second) {
        horner<Degree, 0, numbers>(row, a, out);
        return;
    }
    horner<Degree, 0, 3 * vectors>(row, a, out);
    if constexpr (Uv) horner<Degree, uv_begin, uv_begin + 2 * vectors>(row, a, out);
    else std::fill(out + uv_begin, out + uv_begin + 2 * vectors, 0.0);
}

template <int Degree, Derivatives Order, bool Uv>
void points(const LimitPatches& limit, std::uint32_t patch, std::span<const Vec2d> st, LimitPoint* out) noexcept {
    const std::int32_t root = limit.patches[patch].root;
    Row<Degree> row;
    std::int32_t row_leaf = -1;
    double row_b = 0;
    for (const Vec2d& at : st) {
        const std::int32_t index = leaf_at<Degree>(limit, root, at.x, at.y);
        const LimitLeaf& leaf = limit.leaves[std::size_t(index)];
        const double b = at.y * leaf.scale + leaf.origin.y;
        if (index != row_leaf || b != row_b) row_of<Degree, Order, Uv>(limit, index, b, row);
        row_leaf = index;
        row_b = b;
        point_of<Degree, Order, Uv>(row, at.x * leaf.scale + leaf.origin.x, *out++);
    }
}

// Index of the first point of a lattice row after the leaf. For quads the comparison with the far side of the leaf is exact.
// For triangles rounding may assign points on the diagonal to either leaf, so the leaf of each candidate is looked up.
template <int Degree, class LeafOf>
int end_in_row(const LimitLeaf& leaf, std::int32_t index, double b, double steps, int i, int last,
               const LeafOf& leaf_of) noexcept {
    const double end_a = leaf.scale < 0 ? 0 : Degree == 3 ? leaf.end_a : 1 - b;
    const double line = (end_a - leaf.origin.x) / leaf.scale;
    int end = std::clamp(int(line * steps), i + 1, last + 1); // not beyond the end
    if constexpr (Degree == 3) {
        if (line == 1) return last + 1;
        while (end <= last && end / steps < line) ++end;
    } else {
        while (end <= last && leaf_of(end) == index) ++end;
    }
    return end;
}

template <int Degree, Derivatives Order, bool Uv>
void rows(const LimitPatches& limit, std::uint32_t patch, int rate, int row_begin, int row_end,
          LimitPoint* out) noexcept {
    const std::int32_t root = limit.patches[patch].root;
    const double steps = rate;
    Row<Degree> row;
    for (int j = row_begin; j < row_end; ++j) {
        const double t = j / steps;
        const int last = Degree == 3 ? rate : rate - j;
        const auto leaf_of = [&](int i) { return leaf_at<Degree>(limit, root, i / steps, t); };
        for (int i = 0; i <= last;) {
            const std::int32_t index = leaf_of(i);
            const LimitLeaf leaf = limit.leaves[std::size_t(index)];
            const double b = t * leaf.scale + leaf.origin.y;
            row_of<Degree, Order, Uv>(limit, index, b, row);
            for (const int end = end_in_row<Degree>(leaf, index, b, steps, i, last, leaf_of); i < end; ++i)
                point_of<Degree, Order, Uv>(row, (i / steps) * leaf.scale + leaf.origin.x, *out++);
        }
    }
}

// Calls work(degree, order, has_uv) with compile-time constants.
template <class Work> void choose(const LimitPatches& limit, Derivatives order, const Work& work) noexcept {
    using std::integral_constant;
    const auto with_uv = [&](auto degree, auto constant) {
        limit.has_uv ? work(degree, constant, std::true_type()) : work(degree, constant, std::false_type());
    };
    const auto with_order = [&](auto degree) {
        switch (order) {
        case Derivatives::none: with_uv(degree, integral_constant<Derivatives, Derivatives::none>()); break;
        case Derivatives::first: with_uv(degree, integral_constant<Derivatives, Derivatives::first>()); break;
        case Derivatives::second: with_uv(degree, integral_constant<Derivatives, Derivatives::second>()); break;
        }
    };
    limit.triangles ? with_order(integral_constant<int, 4>()) : with_order(integral_constant<int, 3>());
}

} // namespace

void evaluate(const LimitPatches& limit, std::uint32_t patch, std::span<const Vec2d> st, Derivatives order,
              std::span<LimitPoint> out) noexcept {
    assert(patch < limit.patches.size() && out.size() >= st.size());
    choose(limit, order, [&](auto degree, auto derivatives, auto uvs) {
        points<degree(), derivatives(), uvs()>(limit, patch, st, out.data());
    });
}

void evaluate_rows(const LimitPatches& limit, std::uint32_t patch, int rate, int row_begin, int row_end,
                   Derivatives order, std::span<LimitPoint> out) noexcept {
    assert(patch < limit.patches.size() && rate > 0 && row_begin >= 0 && row_end <= rate + 1);
    choose(limit, order, [&](auto degree, auto derivatives, auto uvs) {
        rows<degree(), derivatives(), uvs()>(limit, patch, rate, row_begin, row_end, out.data());
    });
}

} // namespace bake
