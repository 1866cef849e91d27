// Letters for captions in pictures: printable ASCII in cells of 6 x 10, the same on every machine.
#pragma once
#include <cstdint>

namespace bake {

constexpr int glyph_width = 6, glyph_height = 10;

/// Rows 1 to 9 of the cell, the highest of 5 bits at the left; capitals stand on row 7, descenders reach row 9. The last column
/// and the first row of the cell are empty.
struct Glyph {
    std::uint8_t rows[9];
};

/// The letter, or a box for what is not printable ASCII.
const Glyph& glyph_of(char letter) noexcept;

/// Whether the cell (x, y) from the upper left corner is covered. x < glyph_width, y < glyph_height.
constexpr bool covers(const Glyph& glyph, int x, int y) noexcept {
    return x < 5 && y > 0 && (glyph.rows[y - 1] >> (4 - x) & 1);
}

} // namespace bake
