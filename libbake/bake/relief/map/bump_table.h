// Bump lookup table: the slopes (b_u, b_v) of a height texture at its texel centres, v up, positive where it rises.
#pragma once
#include "bake/base/vec.h"
#include "bake/relief/height/height.h"
#include "bake/relief/height/slope_filter.h"
#include "bake/relief/map/slope_code.h"
#include <functional>

namespace bake {

class Progress;

enum class SlopeUnits {
    difference, ///< h[+1] - h[-1], the plain two-sided difference: twice the slope per texel
    texel,      ///< height per texel
    uv,         ///< height per unit of u and of v
    world,      ///< height per object unit, the picture being extent_u x extent_v
};

struct BumpTableOptions {
    Filter filter = Filter::automatic;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    SlopeUnits units = SlopeUnits::uv;
    double amplitude = 1; ///< height of white above black, object units
    double extent_u = 0;  ///< object units the picture is wide; 0: 1
    double extent_v = 0;  ///< object units it is high; 0: extent_u times its height over its width
};

/// What `automatic` stands for: sobel for 256 levels or fewer, whose steps it amplifies least; c2 otherwise.
Filter resolve_filter(Filter filter, const HeightTexture& height) noexcept;

/// Object units per picture along u and v, the defaults filled in.
Vec2d resolve_extent(double extent_u, double extent_v, int width, int height) noexcept;

/// Factors from slope per texel to the units asked for.
Vec2d slope_scale(const BumpTableOptions& options, int width, int height) noexcept;

/// What a texel of a table holds.
enum class TableLayout {
    slopes,     ///< (b_u, b_v), v up
    bumpslopes, ///< OpenImageIO's (h, s, t, s^2, t^2, s t): s = dh/ds, t = dh/dt with t DOWN the picture
};

/// The table row by row, from any thread.
class BumpTable {
public:
    /// The height must outlive it.
    BumpTable(const HeightTexture& height, const BumpTableOptions& options, TableLayout layout = TableLayout::slopes);
    int width() const noexcept { return height_.values.width(); }
    int height() const noexcept { return height_.values.height(); }
    int channels() const noexcept { return layout_ == TableLayout::slopes ? 2 : 6; }
    Filter filter() const noexcept { return filter_; }
    /// width * channels values of row y.
    void row(int y, float* out, SlopeFilter<float>::Scratch& scratch) const;

private:
    const HeightTexture& height_;
    TableLayout layout_;
    Filter filter_;
    double amplitude_;
    Vec2d scale_;
    SlopeFilter<float> slopes_;
};

/// Hands the table to `consume(values, rows)` in bands of a multiple of 64 rows, from the top, while later bands are
/// being computed: it need never be whole in memory.
void for_bands(const BumpTable& table, const std::function<void(const float*, int)>& consume,
               Progress* progress = nullptr);

/// The whole table.
Image<float> bump_table(const HeightTexture& height, const BumpTableOptions& options,
                        TableLayout layout = TableLayout::slopes);

/// The code whose range is the largest magnitude in the table; 1 for a table of zeros.
SlopeCode code_for(const BumpTable& table);

/// The next mip: half the size, rounded down, at least 1; each texel the mean by area of what it covers, so that first
/// and second moments stay right (slopes and their squares filter linearly, normals do not).
Image<float> halve(const BumpTable& table);
Image<float> halve(const Image<float>& image);

} // namespace bake
