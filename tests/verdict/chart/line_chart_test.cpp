#include "bake/verdict/chart/line_chart.h"
#include "bake/verdict/chart/svg.h"
#include "verdict/chart/svg_pieces.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;
using test::is_well_formed;
using test::svg_all;
using test::SvgPiece;

namespace {

LineChart chart() {
    LineChart out;
    out.title = "Sphere: height over radius";
    out.x_label = "height / radius";
    out.y_label = "error, deg";
    return out;
}

std::size_t words(const std::string& text) {
    std::size_t count = 1;
    for (const char c : text) count += c == ' ';
    return count;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("line_chart_svg: points stand at their values, the mark at its own") {
        LineChart c = chart();
        c.series = {{"blinn", {{0, 0}, {1, 5}, {2, 10}}}};
        c.marks = {{1, "closed form"}};
        const std::string svg = line_chart_svg(c);
        REQUIRE(is_well_formed(svg));
        const SvgPiece p = svg_all(svg, "rect").at(1);
        const double left = p.number("x"), w = p.number("width"), top = p.number("y"), h = p.number("height");
        const std::vector<SvgPiece> dots = svg_all(svg, "circle");
        REQUIRE(dots.size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            const double share = (0.06 + 0.5 * double(i)) / 1.12;
            CHECK(dots[i].number("cx") == doctest::Approx(left + w * share).epsilon(1e-4));
            CHECK(dots[i].number("cy") == doctest::Approx(top + h * (1 - share)).epsilon(1e-4));
        }
        double mark = 0;
        for (const SvgPiece& line : svg_all(svg, "line"))
            if (line.value("stroke") == "#a33") mark = line.number("x1");
        CHECK(mark == doctest::Approx(left + w / 2).epsilon(1e-4));
        CHECK(svg.find(">closed form</text>") != std::string::npos);
    }

    TEST_CASE("line_chart_svg: expected points and the limit stand on the axes of the line") {
        LineChart c = chart();
        c.series = {{.label = "a", .points = {{0, 0}, {2, 4}}, .expected = {{1, 8}, {2, NAN}}}};
        c.limit = 6;
        const std::string svg = line_chart_svg(c);
        REQUIRE(is_well_formed(svg));
        const SvgPiece p = svg_all(svg, "rect").at(1);
        const double left = p.number("x"), w = p.number("width"), top = p.number("y"), h = p.number("height");
        const auto down = [&](double y) { return top + h * (1 - (0.06 + y / 8) / 1.12); };
        std::vector<SvgPiece> expected;
        for (const SvgPiece& dot : svg_all(svg, "circle"))
            if (dot.value("class") == "expected") expected.push_back(dot);
        REQUIRE(expected.size() == 1);
        CHECK(expected[0].number("cx") == doctest::Approx(left + w / 2).epsilon(1e-4));
        CHECK(expected[0].number("cy") == doctest::Approx(down(8)).epsilon(1e-4));
        double limit = 0;
        for (const SvgPiece& line : svg_all(svg, "line"))
            if (line.value("stroke") == "#777") limit = line.number("y1");
        CHECK(limit == doctest::Approx(down(6)).epsilon(1e-4));
    }

    TEST_CASE("line_chart_svg: what is not finite interrupts the line") {
        LineChart c = chart();
        c.series = {{"a", {{0, 1}, {1, 2}, {2, NAN}, {3, 4}, {4, INFINITY}, {5, 6}, {6, 7}, {7, 8}}}};
        const std::string svg = line_chart_svg(c);
        const std::vector<SvgPiece> lines = svg_all(svg, "polyline");
        REQUIRE(lines.size() == 3);
        CHECK(words(lines[0].value("points")) == 2);
        CHECK(words(lines[1].value("points")) == 1);
        CHECK(words(lines[2].value("points")) == 3);
        CHECK(svg_all(svg, "circle").size() == 6);
    }

    TEST_CASE("line_chart_svg: zero on a logarithmic axis stands in a strip; many series are told apart") {
        LineChart c = chart();
        c.logarithmic_x = c.logarithmic_y = true;
        for (int i = 0; i < 21; ++i) c.series.push_back({"series " + std::to_string(i), {{1.0 + i, 1}, {100, 0}}});
        const std::string svg = line_chart_svg(c);
        REQUIRE(is_well_formed(svg));
        const SvgPiece p = svg_all(svg, "rect").at(1);
        CHECK(svg_all(svg, "circle").at(1).number("cy") == doctest::Approx(p.number("y") + p.number("height") - 15));
        std::vector<std::string> styles;
        for (const SvgPiece& line : svg_all(svg, "polyline")) {
            const std::string style = line.value("stroke") + line.value("stroke-dasharray");
            for (const std::string& other : styles) CHECK(other != style);
            styles.push_back(style);
        }
        CHECK(styles.size() == 21);
    }

    TEST_CASE("line_chart_svg: labels of marks at nearly one place do not overlap") {
        LineChart c = chart();
        c.series = {{"a", {{0, 1}, {1, 2}}}};
        for (int i = 0; i < 12; ++i) c.marks.push_back({0.5 + 0.002 * i, "measured " + std::to_string(i)});
        const std::string svg = line_chart_svg(c);
        const double plot = svg_all(svg, "rect").at(1).number("y");
        struct Place {
            double left, right, base;
        };
        std::vector<Place> places;
        for (const SvgPiece& text : svg_all(svg, "text")) {
            if (text.text.compare(0, 8, "measured") != 0) continue;
            const double half = text_width(text.text, 11) / 2;
            const Place place{text.number("x") - half, text.number("x") + half, text.number("y")};
            CHECK(place.base > 30); // beneath the title
            CHECK(place.base < plot);
            for (const Place& other : places)
                CHECK((place.base != other.base || place.left >= other.right || other.left >= place.right));
            places.push_back(place);
        }
        CHECK(places.size() == 12);
    }

    TEST_CASE("line_chart_svg: nothing to draw, and text that XML must escape") {
        CHECK(is_well_formed(line_chart_svg(chart())));
        LineChart c = chart();
        c.title = "<&>";
        c.series = {{"\"<", {}}};
        c.marks = {{NAN, "a"}, {1, "<b>"}};
        CHECK(is_well_formed(line_chart_svg(c)));
    }

    TEST_CASE(
        "line_chart_svg: the key is read from left to right and then downwards, beneath the plot and in the picture") {
        LineChart c = chart();
        for (int i = 0; i < 12; ++i)
            c.series.push_back({"a line with a long name, number " + std::to_string(i), {{0, 0}, {1, double(i)}}});
        const std::string svg = line_chart_svg(c);
        REQUIRE(is_well_formed(svg));
        const double bottom = svg_all(svg, "rect").at(0).number("height");
        double x = 0, y = svg_all(svg, "rect").at(1).number("y") + svg_all(svg, "rect").at(1).number("height");
        int rows = 0, labels = 0;
        for (const SvgPiece& text : svg_all(svg, "text")) {
            if (!text.text.starts_with("a line")) continue;
            ++labels;
            if (text.number("y") == y) {
                CHECK(text.number("x") > x + 50);
            } else {
                CHECK(text.number("y") > y + 10);
                ++rows;
            }
            x = text.number("x"), y = text.number("y");
        }
        CHECK(labels == 12);
        CHECK(rows > 2);
        CHECK(y < bottom);
    }
}
