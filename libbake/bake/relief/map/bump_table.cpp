#include "bake/relief/map/bump_table.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/base/provenance.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {

const char* name(SlopeUnits units) noexcept {
    switch (units) {
    case SlopeUnits::difference: return "difference";
    case SlopeUnits::texel: return "texel";
    case SlopeUnits::uv: return "uv";
    case SlopeUnits::world: break;
    }
    return "world";
}

Filter resolve_filter(Filter filter, const HeightTexture& height) noexcept {
    if (filter != Filter::automatic) return filter;
    return height.levels <= 256 ? Filter::sobel : Filter::c2;
}

Vec2d resolve_extent(double extent_u, double extent_v, int width, int height) noexcept {
    const double u = extent_u > 0 ? extent_u : 1;
    return {u, extent_v > 0 ? extent_v : u * height / width};
}

Vec2d slope_scale(const BumpTableOptions& options, int width, int height) noexcept {
    const Vec2d texels(width, height);
    switch (options.units) {
    case SlopeUnits::difference: return Vec2d(2 * options.amplitude);
    case SlopeUnits::texel: return Vec2d(options.amplitude);
    case SlopeUnits::uv: return options.amplitude * texels;
    case SlopeUnits::world: break;
    }
    return options.amplitude * texels / resolve_extent(options.extent_u, options.extent_v, width, height);
}

Vec2d recorded_scale(const std::string& record, int width, int height) {
    const std::string units = record_word(record, "slope_units");
    const std::vector<double> extent = record_numbers(record, "extent");
    BumpTableOptions options;
    if (extent.size() == 2) options.extent_u = extent[0], options.extent_v = extent[1];
    for (const SlopeUnits known : {SlopeUnits::difference, SlopeUnits::texel, SlopeUnits::uv, SlopeUnits::world})
        if (units == name(known)) options.units = known;
    return Vec2d(width, height) / slope_scale(options, width, height);
}

BumpTable::BumpTable(const HeightTexture& height, const BumpTableOptions& options, TableLayout layout)
    : height_(height), layout_(layout), filter_(resolve_filter(options.filter, height)), amplitude_(options.amplitude),
      scale_(slope_scale(options, height.values.width(), height.values.height())),
      slopes_(height.values, filter_, options.wrap_u, options.wrap_v) {}

void BumpTable::row(int y, float* out, SlopeFilter<float>::Scratch& scratch) const {
    if (layout_ == TableLayout::slopes) return slopes_.row(y, float(scale_.x), float(scale_.y), out, scratch);
    // The pairs go to the end of the row, ahead of where the six values are written.
    float* const pairs = out + std::size_t(4) * width();
    slopes_.row(y, float(scale_.x), -float(scale_.y), pairs, scratch);
    const float* values = height_.values.row(y);
    for (int x = 0; x < width(); ++x) {
        const float s = pairs[2 * x], t = pairs[2 * x + 1];
        float* moments = out + std::size_t(6) * x;
        moments[0] = float(amplitude_) * values[x];
        moments[1] = s;
        moments[2] = t;
        moments[3] = s * s;
        moments[4] = t * t;
        moments[5] = s * t;
    }
}

void for_bands(const BumpTable& table, const std::function<void(const float*, int)>& consume, Progress* progress) {
    // Bands small enough to stay in the cache between the kernel and the writer.
    const std::int64_t row_bytes = std::int64_t(4) * table.width() * table.channels();
    const int band = int(std::clamp<std::int64_t>((std::int64_t(2) << 20) / row_bytes / 64, 1, 16)) * 64;
    const int bands = (table.height() + band - 1) / band;
    std::vector<Image<float>> slots(slot_count());
    std::vector<SlopeFilter<float>::Scratch> scratch(slot_count());
    const auto rows_of = [&](std::int64_t b) { return std::min<int>(band, table.height() - int(b) * band); };
    in_order(
        bands,
        [&](std::int64_t b, int slot) {
            if (slots[slot].empty()) slots[slot] = Image<float>(table.width(), band, table.channels());
            for (int y = 0; y < rows_of(b); ++y) table.row(int(b) * band + y, slots[slot].row(y), scratch[slot]);
        },
        [&](std::int64_t b, int slot) {
            consume(slots[slot].data(), rows_of(b));
            if (progress) progress->add(rows_of(b));
        });
}

Image<float> bump_table(const HeightTexture& height, const BumpTableOptions& options, TableLayout layout) {
    const BumpTable table(height, options, layout);
    Image<float> out(table.width(), table.height(), table.channels());
    for_rows(table.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        SlopeFilter<float>::Scratch scratch;
        for (auto y = int(begin); y < int(end); ++y) table.row(y, out.row(y), scratch);
    });
    return out;
}

SlopeCode code_for(const BumpTable& table) {
    std::vector<float> of_row(table.height());
    for_rows(table.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        SlopeFilter<float>::Scratch scratch;
        std::vector<float> row(std::size_t(table.width()) * table.channels());
        for (auto y = begin; y < end; ++y) {
            table.row(int(y), row.data(), scratch);
            float most = 0;
            for (const float value : row) most = std::max(most, std::abs(value));
            of_row[y] = most;
        }
    });
    const float range = *std::max_element(of_row.begin(), of_row.end());
    return {range > 0 ? range : 1};
}

namespace {

/// The mean by area of n values onto half as many: coarse texel i covers [i n / m, (i + 1) n / m).
struct Cover {
    int first, count;
    float before, after; ///< shares of the first and last texel covered, the ones between counting 1
};

Cover cover(int i, int n, int m) noexcept {
    const std::int64_t begin = std::int64_t(i) * n, end = begin + n; // in units of 1 / m texel
    const std::int64_t first = begin / m, last = (end - 1) / m;
    return {int(first), int(last - first + 1), float((first + 1) * m - begin) / float(m),
            float(end - last * m) / float(m)};
}

float share(const Cover& c, int k) noexcept {
    return k == 0 ? (c.count == 1 ? c.before + c.after - 1 : c.before) : k == c.count - 1 ? c.after : 1.0f;
}

template <class Row> Image<float> halve_rows(int width, int height, int channels, const Row& row_into) {
    Image<float> out(std::max(1, width / 2), std::max(1, height / 2), channels);
    for_rows(out.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        SlopeFilter<float>::Scratch scratch;
        std::vector<float> row(std::size_t(width) * channels), sums(row.size());
        for (auto y = int(begin); y < int(end); ++y) {
            const Cover rows = cover(y, height, out.height());
            std::fill(sums.begin(), sums.end(), 0.0f);
            for (int k = 0; k < rows.count; ++k) {
                row_into(rows.first + k, row.data(), scratch);
                for (std::size_t i = 0; i < row.size(); ++i) sums[i] += share(rows, k) * row[i];
            }
            for (int x = 0; x < out.width(); ++x) {
                const Cover columns = cover(x, width, out.width());
                const float area = float(width) * float(height) / (float(out.width()) * float(out.height()));
                for (int c = 0; c < channels; ++c) {
                    float sum = 0;
                    for (int k = 0; k < columns.count; ++k)
                        sum += share(columns, k) * sums[std::size_t(columns.first + k) * channels + c];
                    out.at(x, y, c) = sum / area;
                }
            }
        }
    });
    return out;
}

} // namespace

Image<float> halve(const BumpTable& table) {
    return halve_rows(table.width(), table.height(), table.channels(),
                      [&](int y, float* out, SlopeFilter<float>::Scratch& scratch) { table.row(y, out, scratch); });
}

Image<float> halve(const Image<float>& image) {
    return halve_rows(image.width(), image.height(), image.channels(),
                      [&](int y, float* out, SlopeFilter<float>::Scratch&) {
                          std::copy_n(image.row(y), std::size_t(image.width()) * image.channels(), out);
                      });
}

} // namespace bake
