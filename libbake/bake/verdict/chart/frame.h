// What charts have in common: the title, two axes with their ticks, the notes beneath.
#pragma once
#include "bake/verdict/chart/axis.h"
#include "bake/verdict/chart/labels.h"
#include <string>
#include <vector>

namespace bake {

struct FrameText {
    std::string title, x_label, y_label; ///< names of the axes with their units
    std::string strip_text = "0";        ///< what stands at the strip of the y axis
    int width = 720, height = 480;       ///< px, without the notes beneath
};

struct Frame {
    Axis x, y;
    Box plot; ///< the strips are inside
};

/// Lays both axes out, with `above` px kept free between title and plot. A chart is at least 200 px wide and high.
Frame frame_of(const FrameText& text, Axis x, Axis y, double above = 0);

/// Where the base line of the first note is.
double notes_top(const FrameText& text);
/// Base lines of notes are this far apart, px.
constexpr double note_height = 15;

/// Opening tag, title, grid, axes and their texts. The picture is higher than text.height by `beneath` px.
std::string draw_frame(const FrameText& text, const Frame& frame, double beneath);

/// The notes, one a line, each cut to the width of the picture.
std::string draw_notes(const FrameText& text, const std::vector<std::string>& notes);

/// "0.3142", "2.5e-7": four digits.
std::string short_number(double value);

} // namespace bake
