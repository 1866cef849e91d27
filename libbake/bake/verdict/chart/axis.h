// An axis of a chart: where a value stands, and its ticks.
#pragma once
#include <string>
#include <vector>

namespace bake {

/// Values the axis has a place for, as positions: log10 of the value on a logarithmic axis, else the value.
struct Axis {
    bool logarithmic = true;
    double low = 0, high = 1;        ///< positions at both ends
    double start_px = 0, end_px = 1; ///< where the two ends are
    bool empty = true;               ///< no value had a position: no ticks
    bool strip = false;              ///< some value had none, and stands before the start:
    double strip_px = 0;             ///< here
};

/// Whether a chart can show the value at all: finite, at most 1e300.
bool is_drawable(double value) noexcept;
/// Whether the value has a position; on a logarithmic axis zero and negative values have none.
bool has_position(const Axis& axis, double value) noexcept;

/// The axis of these values: from the least to the largest with a margin of 6 %, over a factor of 2 at least. Values that are
/// not drawable do not count.
Axis axis_of(const std::vector<double>& values, bool logarithmic);

/// Puts the axis from start_px to end_px, which may be less, the first strip_width of it being the strip if there is one.
void lay_axis(Axis& axis, double start_px, double end_px, double strip_width);

double place_px(const Axis& axis, double value) noexcept;

struct Tick {
    double at = 0;    ///< px
    std::string text; ///< empty: a line without a number
};

/// About `wanted` numbered ticks: 1, 2, 5 times a power of ten, powers of ten, or every k-th of them.
std::vector<Tick> ticks(const Axis& axis, int wanted);

} // namespace bake
