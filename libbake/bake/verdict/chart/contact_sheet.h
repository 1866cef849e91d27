// Pictures side by side with captions, as one picture.
#pragma once
#include "bake/picture/image.h"
#include <string>
#include <vector>

namespace bake {

struct SheetTile {
    std::vector<std::string> caption; ///< lines of printable ASCII; what is not is shown as a box
    Image<float> picture;             ///< sRGB-encoded, three channels
};

struct SheetOptions {
    int columns = 0;   ///< 0: as many as make the sheet about 1.5 times as wide as high
    std::string title; ///< a line above all tiles; empty: none
};

/// The tiles in rows, each beneath its caption, dark on white. Letters are as large as the width of a tile allows (a caption of
/// 36 letters fits, one letter less than 6 px wide is never drawn); a line that is still too wide is cut. Throws
/// Error{Refusal::unsuitable} for pictures of different sizes, or not of three channels. No tiles: an empty image.
Image<float> contact_sheet(const std::vector<SheetTile>& tiles, const SheetOptions& options = {});

/// Where a tile's picture is in the sheet of contact_sheet(), and how large the sheet is.
struct SheetLayout {
    int columns = 0, rows = 0;
    int text_scale = 1;                  ///< px of a cell of a letter
    int margin = 0;                      ///< px around and between tiles
    int title_height = 0;                ///< px
    int caption_height = 0;              ///< px, of the tile with the most lines
    int tile_width = 0, tile_height = 0; ///< px of the pictures
    int width = 0, height = 0;
    int left(int tile) const noexcept { return margin + tile % columns * (tile_width + margin); }
    int top(int tile) const noexcept {
        return margin + title_height + tile / columns * (caption_height + tile_height + margin) + caption_height;
    }
};
SheetLayout sheet_layout(const std::vector<SheetTile>& tiles, const SheetOptions& options = {});

} // namespace bake
