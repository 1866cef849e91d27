#include "bake/surface/chart/uv_raster.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

// Corners are snapped to a grid of about 2^30 steps across the unit square, so fine that snapping is lost in the
// roundings of float uvs; from there on, which texel lies where is decided in integers, without rounding. Triangles
// within the unit square fit 64 bits, others take 128. Bands of rows are the tasks; each goes through its triangles in
// order, first for the centres, then for the texels that no centre claimed.

namespace bake {
namespace {

using Wide = __int128;

constexpr int band_rows = 16;

struct Grid {
    int width, height;
    int bits;          // a texel is 2^bits steps wide; at least 2, so that centres and half texels are on the grid
    std::int64_t step; // 2^bits

    Grid(int w, int h) : width(w), height(h) {
        bits = std::max(2, 30 - int(std::bit_width(unsigned(std::max(w, h) - 1))));
        step = std::int64_t(1) << bits;
    }
};

template <class I> struct Point { I x, y; };

using Corners = std::array<Point<std::int64_t>, 3>;

std::int64_t snapped(double texels, double step) noexcept {
    const double limit = double(std::int64_t(1) << 59); // uvs beyond millions of tiles; products stay within 128 bits
    return std::int64_t(std::floor(std::clamp(texels * step, -limit, limit) + 0.5));
}

// x to the right, y down, as texels run.
Corners corners_of(const Mesh& mesh, const Triangle& triangle, const Grid& grid) noexcept {
    Corners out;
    for (int k = 0; k < 3; ++k) {
        const Vec2f uv = mesh.uvs[mesh.corner_uv[triangle.corner[k]]];
        out[k].x = snapped(double(uv.x) * grid.width, double(grid.step));
        out[k].y = snapped((1 - double(uv.y)) * grid.height, double(grid.step));
    }
    return out;
}

Wide doubled_area(const Corners& c) noexcept {
    return Wide(c[1].x - c[0].x) * (c[2].y - c[0].y) - Wide(c[1].y - c[0].y) * (c[2].x - c[0].x);
}

struct Box {
    std::int64_t x0, x1, y0, y1;
};

Box box_of(const Corners& c) noexcept {
    const auto [x0, x1] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [y0, y1] = std::minmax({c[0].y, c[1].y, c[2].y});
    return {x0, x1, y0, y1};
}

bool inside_square(const Box& box, const Grid& grid) noexcept {
    return box.x0 >= 0 && box.y0 >= 0 && box.x1 <= grid.step * grid.width && box.y1 <= grid.step * grid.height;
}

// Whether the closed triangle, segment or point meets the closed unit square: no side of either divides them.
bool meets_square(const Corners& c, const Box& box, const Grid& grid) noexcept {
    const std::int64_t right = grid.step * grid.width, bottom = grid.step * grid.height;
    if (box.x1 < 0 || box.y1 < 0 || box.x0 > right || box.y0 > bottom) return false;
    const Point<std::int64_t> square[4] = {{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
    for (int k = 0; k < 3; ++k) {
        const auto &a = c[k], &b = c[(k + 1) % 3], &other = c[(k + 2) % 3];
        const auto side = [&](const Point<std::int64_t>& p) {
            return Wide(b.x - a.x) * (p.y - a.y) - Wide(b.y - a.y) * (p.x - a.x);
        };
        const Wide inner = side(other);
        bool all_left = true, all_right = true;
        for (const auto& p : square) {
            const Wide s = side(p);
            all_left &= s > 0;
            all_right &= s < 0;
        }
        if ((all_left && inner <= 0) || (all_right && inner >= 0)) return false;
    }
    return true;
}

template <class I> struct Edge {
    I x, y, dx, dy; // from (x, y); the triangle is where side() >= 0
    I reach;        // what side() changes by from a texel's centre to its farthest corner
    bool owns;      // whether points on the edge are this triangle's and not the one's across it

    I side(I px, I py) const noexcept { return dx * (py - y) - dy * (px - x); }
};

template <class I> struct Shape {
    Edge<I> edge[3]; // edge k runs from corner order[k]
    int order[3];    // the corners, so that area is positive
    double inverse_area;
    Box box;
};

template <class I> Shape<I> shape_of(const Corners& c, const Grid& grid) noexcept {
    Shape<I> shape;
    const Wide area = doubled_area(c);
    shape.order[0] = 0;
    shape.order[1] = area > 0 ? 1 : 2;
    shape.order[2] = area > 0 ? 2 : 1;
    for (int k = 0; k < 3; ++k) {
        const auto &a = c[shape.order[k]], &b = c[shape.order[(k + 1) % 3]];
        Edge<I>& edge = shape.edge[k];
        edge.x = I(a.x), edge.y = I(a.y);
        edge.dx = I(b.x) - I(a.x), edge.dy = I(b.y) - I(a.y);
        edge.reach = ((edge.dx < 0 ? -edge.dx : edge.dx) + (edge.dy < 0 ? -edge.dy : edge.dy)) * I(grid.step / 2);
        edge.owns = edge.dy > 0 || (edge.dy == 0 && edge.dx > 0);
    }
    shape.inverse_area = 1 / double(area > 0 ? area : -area);
    shape.box = box_of(c);
    return shape;
}

// Texels first to last; none when last < first.
struct Span {
    int first, last;
};

template <class I> I floored(I a, I b, bool& exact) noexcept { // b > 0
    const I quotient = a / b, rest = a % b;
    exact = rest == 0;
    return quotient - (rest < 0);
}

// The texels of row y whose centre lies in or on the triangle, or, with `reach`, whose square meets its three
// half-planes; `owned`, when given, gets those whose centre is this triangle's own by the rule for edges.
template <class I> Span span_of(const Shape<I>& shape, const Grid& grid, int y, bool reach, Span* owned = nullptr) {
    const I step = grid.step, half = step / 2, center = I(y) * step + half;
    I first = 0, last = grid.width - 1, own_first = first, own_last = last;
    for (const Edge<I>& edge : shape.edge) {
        // side at the centre of texel i is at - slope * i
        const I at = edge.side(half, center) + (reach ? edge.reach : I(0)), slope = edge.dy * step;
        bool exact;
        if (slope > 0) {
            const I bound = floored(at, slope, exact);
            last = std::min(last, bound);
            own_last = std::min(own_last, bound - (exact && !edge.owns));
        } else if (slope < 0) {
            const I bound = -floored(at, I(-slope), exact);
            first = std::max(first, bound);
            own_first = std::max(own_first, bound + (exact && !edge.owns));
        } else {
            if (at < 0) return {0, -1};
            if (at == 0 && !edge.owns) own_last = -1;
        }
        if (last < first) return {0, -1};
    }
    if (owned) *owned = own_first <= own_last ? Span{int(own_first), int(own_last)} : Span{0, -1};
    return {int(first), int(last)};
}

struct Totals {
    std::int64_t covered = 0, border = 0, overlapped = 0;
};

// The state of a band's texels, one bit each.
struct Band {
    const Grid& grid;
    int begin, end; // rows
    Image<TexelHit>& hits;
    std::size_t words; // per row
    std::vector<std::uint64_t> covered, owned, shared, edged;
    std::vector<double> distance; // squared, of texels that are edged

    struct Owned {
        int y;
        Span span;
    };
    std::vector<Owned> waiting; // spans of the present face: they overlap only with other faces
    std::uint32_t face = no_index;

    Band(const Grid& g, int begin_row, Image<TexelHit>& out)
        : grid(g), begin(begin_row), end(std::min(g.height, begin_row + band_rows)), hits(out),
          words((std::size_t(g.width) + 63) / 64), covered(words * (end - begin)), owned(covered.size()),
          shared(covered.size()), edged(covered.size()) {}

    std::uint64_t* row(std::vector<std::uint64_t>& bits, int y) const { return bits.data() + words * (y - begin); }
};

// Calls work(word, mask) for each 64 texels that the span touches.
template <class Work> void for_words(Span span, Work&& work) {
    for (int w = span.first >> 6; w <= span.last >> 6; ++w) {
        std::uint64_t mask = ~std::uint64_t(0);
        if (w == span.first >> 6) mask &= ~std::uint64_t(0) << (span.first & 63);
        if (w == span.last >> 6) mask &= ~std::uint64_t(0) >> (63 - (span.last & 63));
        work(w, mask);
    }
}

template <class I> void fill(Band& band, const Shape<I>& shape, std::uint32_t triangle, int y, Span span) {
    const I step = band.grid.step, half = step / 2;
    double at[3], slope[3]; // of the corner opposite edge k
    for (int k = 0; k < 3; ++k) {
        const Edge<I>& edge = shape.edge[k];
        const int corner = shape.order[(k + 2) % 3];
        at[corner] = double(edge.side(I(span.first) * step + half, I(y) * step + half)) * shape.inverse_area;
        slope[corner] = -double(edge.dy) * double(step) * shape.inverse_area;
    }
    TexelHit* out = band.hits.row(y);
    std::uint64_t* covered = band.row(band.covered, y);
    const auto put = [&](int i) {
        const double n = i - span.first;
        out[i] = {triangle, float(std::max(0.0, at[1] + slope[1] * n)), float(std::max(0.0, at[2] + slope[2] * n))};
    };
    for_words(span, [&](int w, std::uint64_t mask) {
        std::uint64_t fresh = mask & ~covered[w];
        covered[w] |= mask;
        while (fresh) { // runs of ones
            const int from = std::countr_zero(fresh), length = std::countr_one(fresh >> from);
            for (int i = w * 64 + from; i < w * 64 + from + length; ++i) put(i);
            if (from + length == 64) break;
            fresh &= ~std::uint64_t(0) << (from + length);
        }
    });
}

void settle_owned(Band& band) {
    for (const Band::Owned& item : band.waiting)
        for_words(item.span, [&](int w, std::uint64_t mask) { band.row(band.owned, item.y)[w] |= mask; });
    band.waiting.clear();
}

template <class I> void fill_centres(Band& band, const Shape<I>& shape, std::uint32_t triangle, std::uint32_t face) {
    if (face != band.face) {
        settle_owned(band);
        band.face = face;
    }
    const std::int64_t half = band.grid.step / 2;
    const std::int64_t first = -((half - shape.box.y0) >> band.grid.bits);
    const std::int64_t last = (shape.box.y1 - half) >> band.grid.bits;
    const int begin = int(std::max<std::int64_t>(first, band.begin));
    const int end = int(std::min<std::int64_t>(last, band.end - 1));
    for (int y = begin; y <= end; ++y) {
        Span owned;
        const Span span = span_of(shape, band.grid, y, false, &owned);
        if (span.last < span.first) continue;
        fill(band, shape, triangle, y, span);
        if (owned.last < owned.first) continue;
        for_words(owned,
                  [&](int w, std::uint64_t mask) { band.row(band.shared, y)[w] |= mask & band.row(band.owned, y)[w]; });
        band.waiting.push_back({y, owned});
    }
}

struct Nearest {
    double distance; // squared, in steps
    float b1, b2;
};

// The point of the triangle nearest to the centre of a texel outside it: it lies on an edge.
template <class I> Nearest nearest(const Shape<I>& shape, const Grid& grid, int i, int y) noexcept {
    const I px = I(i) * grid.step + grid.step / 2, py = I(y) * grid.step + grid.step / 2;
    Nearest best{HUGE_VAL, 0, 0};
    for (int k = 0; k < 3; ++k) {
        const Edge<I>& edge = shape.edge[k];
        const double dx = double(edge.dx), dy = double(edge.dy), length = dx * dx + dy * dy;
        const double ax = double(px - edge.x), ay = double(py - edge.y);
        const double bx = double(px - edge.x - edge.dx), by = double(py - edge.y - edge.dy);
        // Both ends alike, so that the triangle across the edge finds the same distance to the last bit.
        const double from_a = ax * dx + ay * dy, from_b = -(bx * dx + by * dy);
        double distance, t;
        if (from_a <= 0) distance = ax * ax + ay * ay, t = 0;
        else if (from_b <= 0) distance = bx * bx + by * by, t = 1;
        else {
            const double side = double(edge.side(px, py));
            distance = side * side / length;
            t = std::min(1.0, from_a / length);
        }
        if (!(distance < best.distance)) continue;
        float weight[3] = {0, 0, 0};
        weight[shape.order[k]] = float(1 - t);
        weight[shape.order[(k + 1) % 3]] = float(t);
        best = {distance, weight[1], weight[2]};
    }
    return best;
}

template <class I> void fill_border(Band& band, const Shape<I>& shape, std::uint32_t triangle) {
    const Grid& grid = band.grid;
    const Box& box = shape.box;
    // A closed square touches the box when its own closed range does.
    const auto first = [&](std::int64_t v) { return -((-v) >> grid.bits) - 1; };
    const int begin = int(std::max<std::int64_t>(first(box.y0), band.begin));
    const int end = int(std::min<std::int64_t>(box.y1 >> grid.bits, band.end - 1));
    const int left = int(std::clamp<std::int64_t>(first(box.x0), 0, grid.width));
    const int right = int(std::clamp<std::int64_t>(box.x1 >> grid.bits, -1, grid.width - 1));
    if (right < left) return;
    for (int y = begin; y <= end; ++y) {
        const std::uint64_t* covered = band.row(band.covered, y);
        bool any = false;
        for_words({left, right}, [&](int w, std::uint64_t mask) { any |= (mask & ~covered[w]) != 0; });
        if (!any) continue;
        Span span = span_of(shape, grid, y, true);
        span = {std::max(span.first, left), std::min(span.last, right)};
        for_words(span, [&](int w, std::uint64_t mask) {
            for (std::uint64_t open = mask & ~covered[w]; open; open &= open - 1) {
                const int bit = std::countr_zero(open), i = w * 64 + bit;
                const Nearest point = nearest(shape, grid, i, y);
                if (band.distance.empty()) band.distance.resize(std::size_t(grid.width) * (band.end - band.begin));
                double& distance = band.distance[std::size_t(grid.width) * (y - band.begin) + i];
                std::uint64_t& edged = band.row(band.edged, y)[w];
                if (edged >> bit & 1 && !(point.distance < distance)) continue;
                edged |= std::uint64_t(1) << bit;
                distance = point.distance;
                band.hits.row(y)[i] = {triangle, point.b1, point.b2};
            }
        });
    }
}

std::int64_t ones(const std::vector<std::uint64_t>& bits) noexcept {
    std::int64_t count = 0;
    for (const std::uint64_t word : bits) count += std::popcount(word);
    return count;
}

Totals raster_band(const Mesh& mesh, const std::vector<Triangle>& triangles, std::span<const std::uint32_t> mine,
                   const Grid& grid, int begin_row, Image<TexelHit>& hits) {
    Band band(grid, begin_row, hits);
    for (int y = band.begin; y < band.end; ++y) std::fill_n(hits.row(y), grid.width, TexelHit{no_index, 0, 0});
    const auto for_shapes = [&](auto&& work) {
        for (const std::uint32_t t : mine) {
            const Corners corners = corners_of(mesh, triangles[t], grid);
            if (inside_square(box_of(corners), grid)) work(shape_of<std::int64_t>(corners, grid), t);
            else work(shape_of<Wide>(corners, grid), t);
        }
    };
    for_shapes([&](const auto& shape, std::uint32_t t) { fill_centres(band, shape, t, triangles[t].face); });
    for_shapes([&](const auto& shape, std::uint32_t t) { fill_border(band, shape, t); });
    return {ones(band.covered), ones(band.edged), ones(band.shared)};
}

// What the baker needs to know of a triangle before it is drawn.
struct Place {
    int first_row = 0, last_row = -1; // that it touches
    bool charted = false, degenerate = false, meets = false, leaves = false;
};

Place place_of(const Corners& corners, const Grid& grid) noexcept {
    Place place;
    const Box box = box_of(corners);
    place.charted = true;
    place.degenerate = doubled_area(corners) == 0;
    place.leaves = !inside_square(box, grid);
    place.meets = !place.leaves || meets_square(corners, box, grid);
    if (place.degenerate || !place.meets) return place;
    place.first_row = int(std::clamp<std::int64_t>(-((-box.y0) >> grid.bits) - 1, 0, grid.height - 1));
    place.last_row = int(std::clamp<std::int64_t>(box.y1 >> grid.bits, 0, grid.height - 1));
    return place;
}

} // namespace

UvRaster uv_raster(const Mesh& mesh, const std::vector<Triangle>& triangles, int width, int height) {
    UvRaster out;
    if (width < 1 || height < 1) return out;
    const Grid grid(width, height);
    out.hits = Image<TexelHit>(width, height, 1);

    std::vector<std::uint8_t> charted(mesh.corner_uv.empty() ? 0 : mesh.faces()); // faces with all their uvs
    for_rows(std::int64_t(charted.size()), 16384, [&](std::int64_t begin, std::int64_t end) {
        const auto uv = mesh.corner_uv.begin();
        for (std::int64_t f = begin; f < end; ++f) {
            const auto last = uv + mesh.face_begin[f + 1];
            charted[f] = std::find(uv + mesh.face_begin[f], last, no_index) == last;
        }
    });
    std::vector<Place> places(charted.empty() ? 0 : triangles.size());
    for_rows(std::int64_t(places.size()), 4096, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t t = begin; t < end; ++t)
            if (charted[triangles[t].face]) places[t] = place_of(corners_of(mesh, triangles[t], grid), grid);
    });

    for (std::size_t t = 0; t < places.size();) {
        const std::uint32_t face = triangles[t].face;
        bool meets = false, leaves = false;
        for (; t < places.size() && triangles[t].face == face; ++t) {
            out.degenerate += places[t].degenerate;
            meets |= places[t].meets;
            leaves |= places[t].leaves;
        }
        if (!charted[face]) continue;
        out.outside_faces += !meets;
        out.crossing_faces += meets && leaves;
    }

    // The triangles of each band, in order.
    const int bands = (height + band_rows - 1) / band_rows;
    std::vector<std::size_t> begins(std::size_t(bands) + 2);
    const auto for_bands = [&](const Place& place, auto&& work) {
        if (place.first_row <= place.last_row)
            for (int b = place.first_row / band_rows; b <= place.last_row / band_rows; ++b) work(b);
    };
    for (const Place& place : places) for_bands(place, [&](int b) { ++begins[b + 2]; });
    for (std::size_t b = 2; b < begins.size(); ++b) begins[b] += begins[b - 1];
    std::vector<std::uint32_t> mine(begins.back());
    for (std::size_t t = 0; t < places.size(); ++t)
        for_bands(places[t], [&](int b) { mine[begins[b + 1]++] = std::uint32_t(t); });

    std::vector<Totals> totals(bands);
    for_rows(bands, 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t b = begin; b < end; ++b) {
            const std::span<const std::uint32_t> own(mine.data() + begins[b], begins[b + 1] - begins[b]);
            totals[b] = raster_band(mesh, triangles, own, grid, int(b) * band_rows, out.hits);
        }
    });
    for (const Totals& total : totals) {
        out.covered += total.covered;
        out.border += total.border;
        out.overlapped += total.overlapped;
    }
    return out;
}

} // namespace bake
