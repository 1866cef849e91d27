#include "bake/surface/chart/uv_raster.h"
#include "bake/base/parallel.h"
#include "bake/surface/chart/texel_grid.h"
#include <algorithm>
#include <span>

// Bands of rows are the tasks. Each band goes through its triangles in order: first for texel centres, then for texels
// whose centre is in no triangle.

namespace bake {
namespace {

using namespace texel_grid;

constexpr int band_rows = PlaceRaster::band_rows;

struct BandTotals {
    std::int64_t covered = 0, border = 0, overlapped = 0;
};

/// The state of the texels of a band, one bit each.
struct RasterBand {
    const TexelGrid& grid;
    int begin, end;    ///< rows
    TexelHit* first;   ///< texel of the band
    std::size_t words; ///< per row
    std::vector<std::uint64_t> covered, owned, shared, bordered;
    std::vector<double> distance; ///< squared, of bordered texels

    struct Owned {
        int y;
        TexelSpan span;
    };
    std::vector<Owned> waiting; ///< spans of the current face: triangles of one face do not overlap
    std::uint32_t face = no_index;

    RasterBand(const TexelGrid& g, int begin_row, TexelHit* hits)
        : grid(g), begin(begin_row), end(std::min(g.height, begin_row + band_rows)), first(hits),
          words((std::size_t(g.width) + 63) / 64), covered(words * (end - begin)), owned(covered.size()),
          shared(covered.size()), bordered(covered.size()) {}

    TexelHit* hits(int y) const noexcept { return first + std::size_t(grid.width) * std::size_t(y - begin); }
    std::uint64_t* row(std::vector<std::uint64_t>& bits, int y) const { return bits.data() + words * (y - begin); }
};

/// Calls work(word, mask) for each word of 64 texels in the span.
template <class Work> void for_words(TexelSpan span, Work&& work) {
    for (int w = span.first >> 6; w <= span.last >> 6; ++w) {
        std::uint64_t mask = ~std::uint64_t(0);
        if (w == span.first >> 6) mask &= ~std::uint64_t(0) << (span.first & 63);
        if (w == span.last >> 6) mask &= ~std::uint64_t(0) >> (63 - (span.last & 63));
        work(w, mask);
    }
}

template <class I>
void fill(RasterBand& band, const TexelTriangle<I>& shape, std::uint32_t triangle, int y, TexelSpan span) {
    const I step = band.grid.step, half = step / 2;
    double at[3], slope[3]; // barycentric at the first texel, and its change per texel
    for (int k = 0; k < 3; ++k) {
        const GridEdge<I>& edge = shape.edge[k];
        const int corner = shape.order[(k + 2) % 3];
        at[corner] = double(edge.side(I(span.first) * step + half, I(y) * step + half)) * shape.inverse_area;
        slope[corner] = -double(edge.dy) * double(step) * shape.inverse_area;
    }
    TexelHit* out = band.hits(y);
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

void add_waiting(RasterBand& band) {
    for (const RasterBand::Owned& item : band.waiting)
        for_words(item.span, [&](int w, std::uint64_t mask) { band.row(band.owned, item.y)[w] |= mask; });
    band.waiting.clear();
}

template <class I>
void fill_centres(RasterBand& band, const TexelTriangle<I>& shape, std::uint32_t triangle, std::uint32_t face) {
    if (face != band.face) {
        add_waiting(band);
        band.face = face;
    }
    const std::int64_t half = band.grid.step / 2;
    const std::int64_t first = -((half - shape.box.y0) >> band.grid.bits);
    const std::int64_t last = (shape.box.y1 - half) >> band.grid.bits;
    const int begin = int(std::max<std::int64_t>(first, band.begin));
    const int end = int(std::min<std::int64_t>(last, band.end - 1));
    for (int y = begin; y <= end; ++y) {
        TexelSpan owned;
        const TexelSpan span = span_of(shape, band.grid, y, false, &owned);
        if (span.last < span.first) continue;
        fill(band, shape, triangle, y, span);
        if (owned.last < owned.first) continue;
        for_words(owned,
                  [&](int w, std::uint64_t mask) { band.row(band.shared, y)[w] |= mask & band.row(band.owned, y)[w]; });
        band.waiting.push_back({y, owned});
    }
}

template <class I> void fill_border(RasterBand& band, const TexelTriangle<I>& shape, std::uint32_t triangle) {
    const TexelGrid& grid = band.grid;
    const GridBox& box = shape.box;
    // Closed squares touch the closed box.
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
        TexelSpan span = span_of(shape, grid, y, true);
        span = {std::max(span.first, left), std::min(span.last, right)};
        for_words(span, [&](int w, std::uint64_t mask) {
            for (std::uint64_t open = mask & ~covered[w]; open; open &= open - 1) {
                const int bit = std::countr_zero(open), i = w * 64 + bit;
                const NearestPoint point = nearest(shape, grid, i, y);
                if (band.distance.empty()) band.distance.resize(std::size_t(grid.width) * (band.end - band.begin));
                double& distance = band.distance[std::size_t(grid.width) * (y - band.begin) + i];
                std::uint64_t& bordered = band.row(band.bordered, y)[w];
                if (bordered >> bit & 1 && !(point.distance < distance)) continue;
                bordered |= std::uint64_t(1) << bit;
                distance = point.distance;
                band.hits(y)[i] = {triangle, point.b1, point.b2};
            }
        });
    }
}

std::int64_t ones(const std::vector<std::uint64_t>& bits) noexcept {
    std::int64_t count = 0;
    for (const std::uint64_t word : bits) count += std::popcount(word);
    return count;
}

BandTotals raster_band(const Mesh& mesh, const std::vector<Triangle>& triangles, std::span<const std::uint32_t> mine,
                       const TexelGrid& grid, int begin_row, bool border, TexelHit* hits) {
    RasterBand band(grid, begin_row, hits);
    for (int y = band.begin; y < band.end; ++y) std::fill_n(band.hits(y), grid.width, TexelHit{no_index, 0, 0});
    const auto for_shapes = [&](auto&& work) {
        for (const std::uint32_t t : mine) {
            const GridTriangle corners = corners_of(mesh, triangles[t], grid);
            if (inside_square(box_of(corners), grid)) work(shape_of<std::int64_t>(corners, grid), t);
            else work(shape_of<Wide>(corners, grid), t);
        }
    };
    for_shapes([&](const auto& shape, std::uint32_t t) { fill_centres(band, shape, t, triangles[t].face); });
    if (border) for_shapes([&](const auto& shape, std::uint32_t t) { fill_border(band, shape, t); });
    return {ones(band.covered), ones(band.bordered), ones(band.shared)};
}

/// What is known of a triangle before it is rastered.
struct TriangleExtent {
    int first_row = 0, last_row = -1; ///< that it touches
    bool charted = false, degenerate = false, touches = false, leaves = false;
};

TriangleExtent extent_of(const GridTriangle& corners, const TexelGrid& grid) noexcept {
    TriangleExtent extent;
    const GridBox box = box_of(corners);
    extent.charted = true;
    extent.degenerate = doubled_area(corners) == 0;
    extent.leaves = !inside_square(box, grid);
    extent.touches = !extent.leaves || touches_square(corners, box, grid);
    if (extent.degenerate || !extent.touches) return extent;
    extent.first_row = int(std::clamp<std::int64_t>(-((-box.y0) >> grid.bits) - 1, 0, grid.height - 1));
    extent.last_row = int(std::clamp<std::int64_t>(box.y1 >> grid.bits, 0, grid.height - 1));
    return extent;
}

/// Per triangle; those of faces with a corner without uv are not charted.
std::vector<TriangleExtent> extents_of(const Mesh& mesh, const std::vector<Triangle>& triangles,
                                       const TexelGrid& grid) {
    std::vector<TriangleExtent> extents(mesh.corner_uv.empty() ? 0 : triangles.size());
    for_rows(std::int64_t(extents.size()), 4096, [&](std::int64_t begin, std::int64_t end) {
        std::uint32_t face = no_index;
        bool charted = false;
        for (std::int64_t t = begin; t < end; ++t) {
            if (triangles[t].face != face) {
                face = triangles[t].face;
                const auto uv = mesh.corner_uv.begin(), last = uv + mesh.face_begin[face + 1];
                charted = std::find(uv + mesh.face_begin[face], last, no_index) == last;
            }
            if (charted) extents[t] = extent_of(corners_of(mesh, triangles[t], grid), grid);
        }
    });
    return extents;
}

void count_faces(const std::vector<Triangle>& triangles, const std::vector<TriangleExtent>& extents, UvRaster& out) {
    for (std::size_t t = 0; t < extents.size();) {
        const std::uint32_t face = triangles[t].face;
        bool charted = false, touches = false, leaves = false;
        for (; t < extents.size() && triangles[t].face == face; ++t) {
            out.degenerate += extents[t].degenerate;
            charted |= extents[t].charted;
            touches |= extents[t].touches;
            leaves |= extents[t].leaves;
        }
        out.outside_faces += charted && !touches;
        out.crossing_faces += touches && leaves;
    }
}

/// The triangles of each band in order: triangle[begin[b]] to triangle[begin[b + 1]].
struct BandTriangles {
    std::vector<std::size_t> begin;
    std::vector<std::uint32_t> triangle;
};

BandTriangles band_triangles(const std::vector<TriangleExtent>& extents, int bands) {
    BandTriangles out;
    out.begin.resize(std::size_t(bands) + 2);
    const auto for_bands = [&](const TriangleExtent& extent, auto&& work) {
        if (extent.first_row <= extent.last_row)
            for (int b = extent.first_row / band_rows; b <= extent.last_row / band_rows; ++b) work(b);
    };
    for (const TriangleExtent& extent : extents) for_bands(extent, [&](int b) { ++out.begin[b + 2]; });
    for (std::size_t b = 2; b < out.begin.size(); ++b) out.begin[b] += out.begin[b - 1];
    out.triangle.resize(out.begin.back());
    for (std::size_t t = 0; t < extents.size(); ++t)
        for_bands(extents[t], [&](int b) { out.triangle[out.begin[b + 1]++] = std::uint32_t(t); });
    return out;
}

} // namespace

UvRaster uv_raster(const Mesh& mesh, const std::vector<Triangle>& triangles, int width, int height) {
    UvRaster out;
    if (width < 1 || height < 1) return out;
    const TexelGrid grid(width, height);
    out.hits = Image<TexelHit>(width, height, 1);
    const std::vector<TriangleExtent> extents = extents_of(mesh, triangles, grid);
    count_faces(triangles, extents, out);
    const int bands = (height + band_rows - 1) / band_rows;
    const BandTriangles of_band = band_triangles(extents, bands);
    std::vector<BandTotals> totals(bands);
    for_rows(bands, 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t b = begin; b < end; ++b) {
            const std::span<const std::uint32_t> own(of_band.triangle.data() + of_band.begin[b],
                                                     of_band.begin[b + 1] - of_band.begin[b]);
            totals[b] =
                raster_band(mesh, triangles, own, grid, int(b) * band_rows, true, out.hits.row(int(b) * band_rows));
        }
    });
    for (const BandTotals& total : totals) {
        out.covered += total.covered;
        out.border += total.border;
        out.overlapped += total.overlapped;
    }
    return out;
}

PlaceRaster::PlaceRaster(const Mesh& mesh, const std::vector<Triangle>& triangles, int width, int height)
    : mesh_(mesh), triangles_(triangles), width_(width), height_(height) {
    // A triangle touches every texel of which it holds a place.
    const std::vector<TriangleExtent> extents = extents_of(mesh, triangles, TexelGrid(width, height));
    BandTriangles of_band = band_triangles(extents, (height + band_rows - 1) / band_rows);
    begin_ = std::move(of_band.begin), triangle_ = std::move(of_band.triangle);
    begin_.pop_back(); // a spare element that band_triangles() needs while it counts
}

void PlaceRaster::band(int band, const Vec2d& place, std::span<TexelHit> hits) const {
    TexelGrid grid(width_, height_);
    grid.moved_x = std::llround((0.5 - place.x) * double(grid.step));
    grid.moved_y = std::llround((0.5 - place.y) * double(grid.step));
    const std::size_t begin = begin_[std::size_t(band)], end = begin_[std::size_t(band) + 1];
    raster_band(mesh_, triangles_, {triangle_.data() + begin, end - begin}, grid, band * band_rows, false, hits.data());
}

} // namespace bake
