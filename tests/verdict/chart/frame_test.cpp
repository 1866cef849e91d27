#include "bake/verdict/chart/frame.h"
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
}
