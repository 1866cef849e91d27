#include "bake/verdict/chart/contact_sheet.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/verdict/chart/glyphs.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// A caption of so many letters fits.
constexpr int letters_across = 36;
constexpr float ink = 0.13f;

/// Columns that make the sheet about 1.5 times as wide as high.
int columns_for(int tiles, double tile_width, double tile_height) {
    int best = 1;
    double least = 0;
    for (int columns = 1; columns <= tiles; ++columns) {
        const int rows = (tiles + columns - 1) / columns;
        // An empty place counts as a fifth of a tile too much.
        const double off = std::abs(std::log(columns * tile_width / (rows * tile_height) / 1.5)) +
                           0.2 * double(columns * rows - tiles) / tiles;
        if (columns > 1 && off >= least) continue;
        best = columns;
        least = off;
    }
    return best;
}

void draw_text(Image<float>& sheet, int left, int top, int scale, int room, const std::string& text) {
    const std::size_t letters = std::min(text.size(), std::size_t(std::max(0, room / (glyph_width * scale))));
    for (std::size_t i = 0; i < letters; ++i) {
        // A line that is cut ends in dots.
        const bool cut = letters < text.size() && letters > 3 && i + 2 >= letters;
        const Glyph& glyph = glyph_of(cut ? '.' : text[i]);
        for (int y = 0; y < glyph_height * scale; ++y)
            for (int x = 0; x < glyph_width * scale; ++x)
                if (covers(glyph, x / scale, y / scale))
                    for (int c = 0; c < 3; ++c) sheet.at(left + int(i) * glyph_width * scale + x, top + y, c) = ink;
    }
}

void require_equal(const std::vector<SheetTile>& tiles) {
    const Image<float>& first = tiles.front().picture;
    for (const SheetTile& tile : tiles) {
        const Image<float>& p = tile.picture;
        if (p.channels() != 3 || p.empty())
            throw Error(Refusal::unsuitable,
                        format("contact sheet: a picture has %d channels; three are needed", p.channels()));
        if (p.width() != first.width() || p.height() != first.height())
            throw Error(Refusal::unsuitable,
                        format("contact sheet: pictures of %d x %d and of %d x %d; one size is needed", first.width(),
                               first.height(), p.width(), p.height()));
    }
}

} // namespace

SheetLayout sheet_layout(const std::vector<SheetTile>& tiles, const SheetOptions& options) {
    SheetLayout out;
    if (tiles.empty()) return out;
    require_equal(tiles);
    const int count = int(tiles.size());
    out.tile_width = tiles.front().picture.width();
    out.tile_height = tiles.front().picture.height();
    out.text_scale = std::max(1, out.tile_width / (letters_across * glyph_width));
    std::size_t lines = 0;
    for (const SheetTile& tile : tiles) lines = std::max(lines, tile.caption.size());
    const int line = glyph_height * out.text_scale;
    out.margin = 8 * out.text_scale;
    out.caption_height = int(lines) * line + (lines > 0 ? 2 * out.text_scale : 0);
    out.title_height = options.title.empty() ? 0 : line + out.margin;
    out.columns = options.columns > 0 ? std::min(options.columns, count)
                                      : columns_for(count, out.tile_width + out.margin,
                                                    out.tile_height + out.caption_height + out.margin);
    out.rows = (count + out.columns - 1) / out.columns;
    out.width = out.margin + out.columns * (out.tile_width + out.margin);
    out.height = out.margin + out.title_height + out.rows * (out.caption_height + out.tile_height + out.margin);
    return out;
}

Image<float> contact_sheet(const std::vector<SheetTile>& tiles, const SheetOptions& options) {
    if (tiles.empty()) return {};
    const SheetLayout layout = sheet_layout(tiles, options);
    Image<float> sheet(layout.width, layout.height, 3);
    std::fill(sheet.data(), sheet.data() + sheet.size(), 1.0f);
    const int scale = layout.text_scale;
    draw_text(sheet, layout.margin, layout.margin, scale, layout.width - 2 * layout.margin, options.title);
    for (int i = 0; i < int(tiles.size()); ++i) {
        const SheetTile& tile = tiles[std::size_t(i)];
        const int left = layout.left(i), top = layout.top(i);
        // The last line stands at the picture, whatever the number of lines.
        int base = top - 2 * scale - int(tile.caption.size()) * glyph_height * scale;
        for (const std::string& line : tile.caption) {
            draw_text(sheet, left, base, scale, layout.tile_width, line);
            base += glyph_height * scale;
        }
        for (int y = 0; y < layout.tile_height; ++y)
            std::copy_n(tile.picture.row(y), std::size_t(layout.tile_width) * 3, &sheet.at(left, top + y));
    }
    return sheet;
}

} // namespace bake
