#include "bake/verdict/chart/frame.h"
#include "bake/verdict/chart/svg.h"
#include "verdict/chart/svg_pieces.h"
#include <algorithm>
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE(
        "frame: the plot lies inside the picture, with room for the title, the numbers and the names of the axes") {
        for (const auto& [width, height] : {std::pair(720, 480), {200, 200}, {1500, 300}, {10, 10}}) {
            const FrameText text{.title = "t", .x_label = "x", .y_label = "y", .width = width, .height = height};
            const double across = std::max(width, 200), down = std::max(height, 200);
            for (const double above : {0.0, 20.0}) {
                const Frame frame = frame_of(text, axis_of({1, 1e6}, false), axis_of({0, 1e-4, 10}, true), above);
                CHECK(frame.plot.left >= 30);
                CHECK(frame.plot.right <= across - 10);
                CHECK(frame.plot.right - frame.plot.left > across / 2);
                CHECK(frame.plot.top >= 24 + above);
                CHECK(frame.plot.bottom <= down - 40); // two lines
                CHECK(frame.plot.bottom - frame.plot.top > down / 3);
                CHECK(frame.x.start_px == frame.plot.left);
                CHECK(frame.x.end_px == frame.plot.right);
                CHECK(frame.y.end_px == frame.plot.top);
                CHECK(frame.y.start_px < frame.plot.bottom); // beneath is the strip of values up to 0
            }
        }
        CHECK(notes_top({.height = 480}) > 480);
    }

    TEST_CASE("frame: numbers stand outside the plot and inside the picture, and the names of the axes beyond them") {
        const FrameText text{.title = "t", .x_label = "along", .y_label = "up"};
        const Frame frame = frame_of(text, axis_of({0, 1, 1e3}, true), axis_of({0, 1e-4, 10}, true));
        REQUIRE((frame.x.strip && frame.y.strip));
        const std::string svg = draw_frame(text, frame, 0) + "</svg>";
        double lowest = frame.plot.bottom, x_label = 0, y_label = 0, leftmost = frame.plot.left;
        int beneath = 0, beside = 0;
        for (const test::SvgPiece& piece : test::svg_all(svg, "text")) {
            const double x = piece.number("x"), y = piece.number("y");
            if (piece.text == "t") continue;
            if (piece.text == "along") {
                x_label = y;
            } else if (piece.text == "up") {
                y_label = x;
            } else if (piece.value("text-anchor") == "middle") { // of the x axis
                CHECK(y > frame.plot.bottom + 8);
                CHECK((x >= frame.plot.left && x <= frame.plot.right));
                lowest = std::max(lowest, y), ++beneath;
            } else {
                CHECK(x < frame.plot.left);
                CHECK((y > frame.plot.top && y < frame.plot.bottom + 8));
                leftmost = std::min(leftmost, x - text_width(piece.text, 11)), ++beside;
            }
        }
        CHECK(beneath > 3);
        CHECK(beside > 3);
        CHECK(x_label > lowest + 10);
        CHECK(x_label < text.height);
        CHECK((y_label > 8 && y_label <= leftmost));
    }
}
