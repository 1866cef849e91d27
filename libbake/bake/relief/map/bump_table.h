// Bump lookup table: the slopes (b_u, b_v) of a height texture at its texel centres. v points up; rising is positive.
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
    world,      ///< height per object unit, for a picture of extent_u x extent_v object units
};

/// "difference", "texel", "uv" or "world".
const char* name(SlopeUnits units) noexcept;

struct BumpTableOptions {
    Filter filter = Filter::automatic;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    SlopeUnits units = SlopeUnits::uv;
    double amplitude = 1; ///< height of white above black, object units
    double extent_u = 0;  ///< width of the picture in object units; 0: 1
    double extent_v = 0;  ///< height of the picture; 0: extent_u * its rows / its columns
};

/// Resolves `automatic`: sobel for heights of at most 256 levels, because it amplifies their steps least, otherwise c2.
Filter resolve_filter(Filter filter, const HeightTexture& height) noexcept;

/// Width and height of the picture in object units, with the defaults resolved.
Vec2d resolve_extent(double extent_u, double extent_v, int width, int height) noexcept;

/// Factors from slope per texel to `options.units`, along u and v.
Vec2d slope_scale(const BumpTableOptions& options, int width, int height) noexcept;

/// Factors that turn the slopes of a table of so many texels to slopes per unit of u and v, where the record of its file
/// (base/provenance.h) says its units; 1 for a record that does not.
Vec2d recorded_scale(const std::string& record, int width, int height);

/// What a texel of a table holds.
enum class TableLayout {
    slopes,     ///< (b_u, b_v), v up
    bumpslopes, ///< OpenImageIO's (h, h_s, h_t, h_s^2, h_t^2, h_s h_t); t points DOWN the picture
};

/// Computes the table row by row, on any thread.
class BumpTable {
public:
    /// The height must outlive this object.
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

/// Calls consume(values, rows) for bands of the table from the top down, while later bands are computed, so that the
/// table is never in memory as a whole. All bands but the last have a multiple of 64 rows.
void for_bands(const BumpTable& table, const std::function<void(const float*, int)>& consume,
               Progress* progress = nullptr);

/// The whole table.
Image<float> bump_table(const HeightTexture& height, const BumpTableOptions& options,
                        TableLayout layout = TableLayout::slopes);

/// The code whose range is the largest absolute value in the table; range 1 for a table of zeros.
SlopeCode code_for(const BumpTable& table);

/// The next mip level: half the size, rounded down, at least 1. A texel is the area-weighted mean of the texels that it
/// covers, which preserves first and second moments (slopes and their squares can be averaged, normals cannot).
Image<float> halve(const BumpTable& table);
Image<float> halve(const Image<float>& image);

} // namespace bake
