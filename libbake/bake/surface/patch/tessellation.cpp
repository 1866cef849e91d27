#include "bake/surface/patch/tessellation.h"

namespace bake {
namespace {

std::uint32_t largest_side(const PatchRates& r) noexcept {
    std::uint32_t most = 1;
    for (int i = 0; i < r.sides; ++i) most = std::max(most, r.side[i]);
    return most;
}

bool on_lattice(const PatchRates& r) noexcept {
    for (int i = 0; i < r.sides; ++i)
        if (r.side[i] != (i % 2 == 0 || r.sides == 3 ? r.across : r.up)) return false;
    return true;
}

bool is_ladder(const PatchRates& r) noexcept {
    return r.sides == 4 && ((r.side[0] == 1 && r.side[2] == 1) || (r.side[1] == 1 && r.side[3] == 1));
}

bool has_inside(const PatchRates& r) noexcept { return r.sides == 4 ? r.across >= 2 && r.up >= 2 : r.across >= 3; }

/// Points before row j >= 1 of a triangle's inner lattice of m segments.
std::uint32_t triangle_rows(std::uint32_t m, std::uint32_t j) noexcept { return (j - 1) * (m - 1) - j * (j - 1) / 2; }

/// Inner points by their row and column in the lattice.
struct Inside {
    const PatchRates& rates;
    std::uint32_t first;
    FaceCorner operator()(std::uint32_t i, std::uint32_t j) const noexcept {
        const std::uint32_t row = rates.sides == 4 ? (j - 1) * (rates.across - 1) : triangle_rows(rates.across, j);
        const std::uint32_t index = first + row + i - 1;
        return {index, index, index};
    }
};

/// The strip between a chain of `outer_count` segments and a chain to the left of it that runs the same way. later(i, j) is
/// negative if the middle of the outer segment i comes before that of the inner segment j, and 0 to make a quad of both.
template <class Outer, class Inner, class Later, class Sink>
void emit_strip(std::uint32_t outer_count, const Outer& outer, std::uint32_t inner_count, const Inner& inner,
                const Later& later, Sink& sink) {
    std::uint32_t i = 0, j = 0;
    while (i < outer_count || j < inner_count) {
        const std::int64_t order = j == inner_count ? -1 : i == outer_count ? 1 : later(i, j);
        if (order == 0) {
            sink.quad(outer(i), outer(i + 1), inner(j + 1), inner(j));
            ++i, ++j;
        } else if (order < 0) {
            sink.triangle(outer(i), outer(i + 1), inner(j));
            ++i;
        } else {
            sink.triangle(outer(i), inner(j + 1), inner(j));
            ++j;
        }
    }
}

template <class Sink> void emit_ladder(const PatchRates& r, const PatchRing& ring, Sink& sink) {
    const int low = r.side[1] == 1 && r.side[3] == 1 ? 0 : 1;
    const std::int64_t a = r.side[low], b = r.side[low + 2];
    emit_strip(
        std::uint32_t(a), [&](std::uint32_t i) { return ring.side[low][i]; }, //
        std::uint32_t(b), [&](std::uint32_t j) { return ring.side[low + 2][b - j]; },
        [&](std::int64_t i, std::int64_t j) {
            const std::int64_t order = (2 * i + 1) * b - (2 * j + 1) * a;
            return order != 0 ? order : std::int64_t(a == b ? 0 : -1);
        },
        sink);
}

template <class Sink> void emit_fan(const PatchRates& r, const PatchRing& ring, Sink& sink) {
    int start = 0;
    while (start < r.sides - 1 && r.side[start] != 2) ++start;
    const FaceCorner hub = ring.side[start][1];
    FaceCorner previous = ring.side[start].back();
    for (int k = 1; k < r.sides; ++k) {
        const int side = (start + k) % r.sides;
        for (std::uint32_t i = 1; i <= r.side[side]; ++i) {
            const FaceCorner next = ring.side[side][i];
            sink.triangle(hub, previous, next);
            previous = next;
        }
    }
}

template <class Sink> void emit_strips(const PatchRates& r, const PatchRing& ring, const Inside& inside, Sink& sink) {
    const std::uint32_t m = r.across, n = r.sides == 4 ? r.up : r.across;
    if (r.sides == 4) {
        for (std::uint32_t j = 1; j + 1 < n; ++j)
            for (std::uint32_t i = 1; i + 1 < m; ++i)
                sink.quad(inside(i, j), inside(i + 1, j), inside(i + 1, j + 1), inside(i, j + 1));
    } else {
        for (std::uint32_t j = 1; j + 2 < m; ++j)
            for (std::uint32_t i = 1; i + j + 1 < m; ++i) {
                sink.triangle(inside(i, j), inside(i + 1, j), inside(i, j + 1));
                if (i + j + 2 < m) sink.triangle(inside(i + 1, j), inside(i + 1, j + 1), inside(i, j + 1));
            }
    }
    for (int side = 0; side < r.sides; ++side) {
        const std::int64_t e = r.side[side], lattice = r.sides == 3 || side % 2 == 0 ? m : n;
        const auto inner = [&](std::uint32_t k) {
            const std::uint32_t ahead = k + 1;
            if (r.sides == 3) {
                if (side == 0) return inside(ahead, 1);
                return side == 1 ? inside(m - 1 - ahead, ahead) : inside(1, m - 1 - ahead);
            }
            if (side == 0) return inside(ahead, 1);
            if (side == 1) return inside(m - 1, ahead);
            return side == 2 ? inside(m - ahead, n - 1) : inside(1, n - ahead);
        };
        // The inner chain is the first row of the lattice. On a triangle it is half a step shorter at both ends.
        const std::int64_t shift = r.sides == 4 ? 3 : 4;
        emit_strip(
            std::uint32_t(e), [&](std::uint32_t i) { return ring.side[side][i]; }, //
            std::uint32_t(lattice - (r.sides == 4 ? 2 : 3)), inner,
            [&](std::int64_t i, std::int64_t j) {
                const std::int64_t order = (2 * i + 1) * lattice - (2 * j + shift) * e;
                return order != 0 ? order : std::int64_t(r.sides == 4 && e == lattice ? 0 : -1);
            },
            sink);
    }
}

template <class Sink>
void emit_triangle_lattice(const PatchRates& r, const PatchRing& ring, const Inside& inside, Sink& sink) {
    const std::uint32_t m = r.across;
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        if (j == 0) return ring.side[0][i];
        if (i == 0) return ring.side[2][m - j];
        if (i + j == m) return ring.side[1][j];
        return inside(i, j);
    };
    for (std::uint32_t j = 0; j < m; ++j)
        for (std::uint32_t i = 0; i + j < m; ++i) {
            sink.triangle(at(i, j), at(i + 1, j), at(i, j + 1));
            if (i + j + 1 < m) sink.triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
}

} // namespace

PatchPattern pattern(const PatchRates& r) noexcept {
    if (on_lattice(r)) return PatchPattern::lattice;
    if (has_inside(r)) return PatchPattern::strips;
    return is_ladder(r) ? PatchPattern::ladder : PatchPattern::fan;
}

PatchRates fitted(PatchRates r) noexcept {
    if (r.sides == 3) {
        if (!has_inside(r)) {
            const bool even = r.side[0] == r.side[1] && r.side[1] == r.side[2];
            r.across = largest_side(r) > 2 ? 3 : even ? r.side[0] : 1;
        }
        r.up = r.across;
        return r;
    }
    if (on_lattice(r) || has_inside(r)) return r;
    // Without points inside: a lattice of one row, a ladder or a fan.
    if (is_ladder(r) && r.side[0] == r.side[2] && r.side[1] == r.side[3]) r.across = r.side[0], r.up = r.side[1];
    else if (!is_ladder(r) && largest_side(r) > 2) r.across = std::max(r.across, 2u), r.up = std::max(r.up, 2u);
    return r;
}

std::uint32_t inner_points(const PatchRates& r) noexcept {
    if (!has_inside(r)) return 0;
    return r.sides == 4 ? (r.across - 1) * (r.up - 1) : (r.across - 1) * (r.across - 2) / 2;
}

FaceWriter::FaceWriter(Mesh& mesh, std::uint64_t face, std::uint64_t corner) noexcept
    : begin_(mesh.face_begin.data()), position_(mesh.corner_position.data()), normal_(mesh.corner_normal.data()),
      uv_(mesh.corner_uv.empty() ? nullptr : mesh.corner_uv.data()), face_(face), corner_(corner) {}

void FaceWriter::polygon(std::array<FaceCorner, 4> corners) noexcept {
    int kept = 0;
    for (int i = 0; i < 4; ++i)
        if (corners[i].position != corners[(i + 3) % 4].position) ++kept;
    if (kept < 3) return;
    for (int i = 0; i < 4; ++i)
        if (corners[i].position != corners[(i + 3) % 4].position) put(corners[i]);
    close();
}

template <class Sink>
void emit_rows(const PatchRates& r, const PatchRing& ring, std::uint32_t inner, std::uint32_t first, std::uint32_t last,
               Sink& sink) {
    const std::uint32_t m = r.across, n = r.up;
    // The points of a row are two on the border, with consecutive numbers between them.
    const auto emit = [&](std::uint32_t j, const auto& low, const auto& high) {
        const FaceCorner left[2] = {ring.side[3][n - j], ring.side[3][n - j - 1]};
        const FaceCorner right[2] = {ring.side[1][j], ring.side[1][j + 1]};
        if (m == 1) return sink.quad(left[0], right[0], right[1], left[1]);
        sink.quad(left[0], low(1), high(1), left[1]);
        for (std::uint32_t i = 1; i + 1 < m; ++i) sink.quad(low(i), low(i + 1), high(i + 1), high(i));
        sink.quad(low(m - 1), right[0], right[1], high(m - 1));
    };
    for (std::uint32_t j = first; j < last; ++j) {
        const auto row = [&](std::uint32_t k) {
            return [begin = inner + (k - 1) * (m - 1) - 1](std::uint32_t i) {
                return FaceCorner{begin + i, begin + i, begin + i};
            };
        };
        const auto bottom = [&](std::uint32_t i) { return ring.side[0][i]; };
        const auto top = [&](std::uint32_t i) { return ring.side[2][m - i]; };
        if (j == 0 && n == 1) emit(j, bottom, top);
        else if (j == 0) emit(j, bottom, row(1));
        else if (j + 1 == n) emit(j, row(j), top);
        else emit(j, row(j), row(j + 1));
    }
}

template <class Sink> void emit_faces(const PatchRates& rates, const PatchRing& ring, std::uint32_t inner, Sink& sink) {
    const Inside inside{rates, inner};
    switch (pattern(rates)) {
    case PatchPattern::lattice:
        if (rates.sides == 4) emit_rows(rates, ring, inner, 0, rates.up, sink);
        else emit_triangle_lattice(rates, ring, inside, sink);
        break;
    case PatchPattern::ladder: emit_ladder(rates, ring, sink); break;
    case PatchPattern::fan: emit_fan(rates, ring, sink); break;
    case PatchPattern::strips: emit_strips(rates, ring, inside, sink); break;
    }
}

template void emit_faces<FaceWriter>(const PatchRates&, const PatchRing&, std::uint32_t, FaceWriter&);
template void emit_faces<FaceCounter>(const PatchRates&, const PatchRing&, std::uint32_t, FaceCounter&);
template void emit_faces<FaceVisitor>(const PatchRates&, const PatchRing&, std::uint32_t, FaceVisitor&);
template void emit_rows<FaceWriter>(const PatchRates&, const PatchRing&, std::uint32_t, std::uint32_t, std::uint32_t,
                                    FaceWriter&);
template void emit_rows<FaceCounter>(const PatchRates&, const PatchRing&, std::uint32_t, std::uint32_t, std::uint32_t,
                                     FaceCounter&);

} // namespace bake
