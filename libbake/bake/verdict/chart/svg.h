// Elements of an SVG 1.1 picture as text. The same input gives the same bytes.
#pragma once
#include <string>
#include <string_view>

namespace bake {

/// `text` between tags or in an attribute: printable(), with & < > " ' as entities.
std::string xml_text(std::string_view text);

/// A length or a place, px: at most two decimals, no trailing zeros, no "-0".
std::string px(double value);

/// The width of one line of text in the widest of the usual sans-serif fonts, px; an upper limit for the others. `size` is the
/// font's, px.
double text_width(std::string_view text, double size);

/// `text`, or as many of its first characters as fit beside an ellipsis.
std::string fitted(std::string_view text, double size, double width);

enum class Anchor { start, middle, end };

struct TextStyle {
    double size = 12; ///< px
    Anchor anchor = Anchor::start;
    const char* colour = "#222";
    bool bold = false;
    bool upwards = false; ///< turned by 90 degrees, read from the bottom to the top
};

/// A text whose base line starts, has its middle, or ends at (x, y).
std::string svg_text(double x, double y, std::string_view text, const TextStyle& style = {});

/// A straight line; `style` are further attributes, such as stroke="#222".
std::string svg_line(double x0, double y0, double x1, double y1, std::string_view style);

/// The opening tag with a name for screen readers and a white background; the picture ends with "</svg>\n".
std::string svg_start(double width, double height, std::string_view title);

} // namespace bake
