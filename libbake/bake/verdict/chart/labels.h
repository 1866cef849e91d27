// Places for the labels of the dots of a chart.
#pragma once
#include <optional>
#include <vector>

namespace bake {

struct Point2 {
    double x = 0, y = 0;
};

/// A rectangle, px, y downwards.
struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// Whether the two share area.
bool overlap(const Box& a, const Box& b) noexcept;
/// Whether any point of the line is inside the box.
bool crosses(const Box& box, const Point2& from, const Point2& to) noexcept;

struct LabelRequest {
    Point2 dot;
    double radius = 0;            ///< of the dot
    double width = 0, height = 0; ///< of the label
};

struct PlacedLabel {
    Box box;
    bool far = false; ///< wants a line to its dot:
    Point2 from, to;  ///< from the border of the dot to the border of the label
};

/// A place in `area` for each label, in the order given: the nearest to its dot that overlaps no dot and no earlier label.
/// Lines to dots avoid labels and dots, and labels avoid `lines`, where a place a little farther away allows it. None where
/// there is no such place within 180 px of the dot.
std::vector<std::optional<PlacedLabel>> place_labels(const std::vector<LabelRequest>& requests, const Box& area,
                                                     const std::vector<Box>& lines = {});

} // namespace bake
