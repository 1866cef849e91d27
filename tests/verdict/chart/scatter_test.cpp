#include "bake/verdict/chart/labels.h"
#include "bake/verdict/chart/scatter.h"
#include "bake/verdict/chart/svg.h"
#include "verdict/chart/svg_pieces.h"
#include <cmath>
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using test::is_well_formed;
using test::svg_all;
using test::SvgPiece;

namespace {

ScatterChart chart(std::vector<ChartDot> dots) {
    ScatterChart out;
    out.title = "FLIP against time";
    out.x_label = "render, s";
    out.y_label = "FLIP, mean";
    out.dots = std::move(dots);
    return out;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The rectangle of the plot.
Box plot(const std::string& svg) {
    const SvgPiece p = svg_all(svg, "rect").at(1);
    return {p.number("x"), p.number("y"), p.number("x") + p.number("width"), p.number("y") + p.number("height")};
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("scatter_svg: dots stand at their logarithms, 6 % from the borders, the front filled") {
        const std::string svg =
            scatter_svg(chart({{"plain", 1, 0.1}, {"bump", 10, 0.01}, {"displaced", 100, 0.001}, {"bad", 100, 0.1}}));
        REQUIRE(is_well_formed(svg));
        const Box p = plot(svg);
        const double w = p.right - p.left, h = p.bottom - p.top;
        const std::vector<SvgPiece> dots = svg_all(svg, "circle");
        REQUIRE(dots.size() == 4);
        const double along[] = {0, 0.5, 1, 1}, up[] = {1, 0.5, 0, 1};
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(dots[i].number("cx") == doctest::Approx(p.left + w * (0.06 + along[i]) / 1.12).epsilon(1e-4));
            CHECK(dots[i].number("cy") == doctest::Approx(p.bottom - h * (0.06 + up[i]) / 1.12).epsilon(1e-4));
            CHECK((dots[i].value("fill") == "#fff") == (i == 3));
        }
        for (const char* label : {">plain</text>", ">bump</text>", ">displaced</text>", ">bad</text>"})
            CHECK(contains(svg, label));
        CHECK(contains(svg, "<title>bump: render, s: 10; FLIP, mean: 0.01</title>"));
        CHECK(contains(svg, "data-dot=\"3\""));
    }

    TEST_CASE("scatter_svg: a label stands in the middle of its ground") {
        const std::string svg = scatter_svg(chart({{"plain", 1, 0.1}, {"bump+roughness", 10, 0.01}, {"d", 100, 0.2}}));
        std::vector<SvgPiece> pieces;
        for (const SvgPiece& piece : test::svg_pieces(svg))
            if (piece.is("rect") || piece.is("text")) pieces.push_back(piece);
        int labels = 0;
        for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
            const SvgPiece &ground = pieces[i], &label = pieces[i + 1];
            if (ground.value("fill-opacity").empty()) continue;
            REQUIRE(label.is("text"));
            CHECK(label.value("text-anchor") == "middle");
            CHECK(label.number("x") == doctest::Approx(ground.number("x") + ground.number("width") / 2).epsilon(1e-3));
            CHECK(label.number("y") > ground.number("y"));
            CHECK(label.number("y") < ground.number("y") + ground.number("height"));
            CHECK(ground.number("width") > 0.9 * text_width(label.text, 11));
            ++labels;
        }
        CHECK(labels == 3);
    }

    TEST_CASE("scatter_svg: the line of the front goes from dot to dot in steps, in the order of cost") {
        const std::string svg =
            scatter_svg(chart({{"b", 10, 0.01}, {"c", 100, 0.001}, {"a", 1, 0.1}, {"bad", 50, 0.2}}));
        const std::vector<SvgPiece> dots = svg_all(svg, "circle");
        const auto at = [&](std::size_t x, std::size_t y) { return dots[x].value("cx") + "," + dots[y].value("cy"); };
        CHECK(svg_all(svg, "polyline").at(0).value("points") ==
              at(2, 2) + " " + at(0, 2) + " " + at(0, 0) + " " + at(1, 0) + " " + at(1, 1));
    }

    TEST_CASE("scatter_svg: zero costs and errors up to the noise stand in strips of their own, named so") {
        ScatterChart c = chart({{"a", 0, 0.1}, {"b", 1, 1e-6}, {"c", 2, 0}, {"d", 3, 0.01}});
        c.noise = 1e-5;
        const std::string svg = scatter_svg(c);
        const Box p = plot(svg);
        const std::vector<SvgPiece> dots = svg_all(svg, "circle");
        CHECK(dots[0].number("cx") == doctest::Approx(p.left + 15));
        CHECK(dots[1].number("cy") == doctest::Approx(p.bottom - 15));
        CHECK(dots[2].number("cy") == doctest::Approx(p.bottom - 15));
        CHECK(dots[1].value("fill") != "#fff");
        CHECK(dots[2].value("fill") == "#fff"); // as exact as far as one can see, and dearer
        CHECK(contains(svg, ">\xE2\x89\xA4 1e-5</text>"));
        CHECK_FALSE(contains(scatter_svg(chart({{"a", 1, 0.1}, {"b", 2, 0.2}})), "stroke-dasharray"));
    }

    TEST_CASE("scatter_svg: an error bar ends at its errors, one that reaches zero at the axis") {
        const std::string svg = scatter_svg(chart({{"a", 1, 0.1, 0.01, 1}, {"b", 10, 0.1, -0.1, 1}}));
        const Box p = plot(svg);
        const double h = p.bottom - p.top;
        std::vector<SvgPiece> bars;
        for (const SvgPiece& line : svg_all(svg, "line"))
            if (line.number("x1") == line.number("x2") && line.value("stroke") != "#ddd" &&
                line.value("stroke") != "#f0f0f0")
                bars.push_back(line);
        REQUIRE(bars.size() == 2);
        CHECK(bars[0].number("y1") == doctest::Approx(p.bottom - h * 1.06 / 1.12).epsilon(1e-4));
        CHECK(bars[0].number("y2") == doctest::Approx(p.bottom - h * 0.06 / 1.12).epsilon(1e-4));
        CHECK(bars[1].number("y2") == doctest::Approx(p.bottom));
    }

    TEST_CASE("scatter_svg: what is not finite is listed beneath, and strange labels are text") {
        const double nan = std::nan("");
        const std::string svg = scatter_svg(chart({{"<b>&\"'", 1, 0.1}, {"none", nan, 1}, {"wild", 1, INFINITY}}));
        CHECK(is_well_formed(svg));
        CHECK(contains(svg, ">&lt;b&gt;&amp;&quot;&#39;</text>"));
        CHECK(contains(svg, "Not drawn: none (render, s: nan;"));
        CHECK(contains(svg, "Not drawn: wild"));
        CHECK(svg_all(svg, "circle").size() == 1);
        for (const ScatterChart& c :
             {chart({}), chart({{"a", 0, 0}}), chart({{"a", 1e-300, 1e300}, {"b", 1e300, 5e-324}})}) {
            const std::string strange = scatter_svg(c);
            CHECK(is_well_formed(strange));
            CHECK_FALSE(contains(strange, "\"nan"));
            CHECK_FALSE(contains(strange, "\"inf"));
        }
    }

    TEST_CASE("scatter_svg: in 200 random charts each dot is inside, and each label is in the plot or beneath, once") {
        std::mt19937 random(3);
        const auto power = [&](double decades) { return std::pow(10, decades * double(random()) / 4294967296.0); };
        for (int round = 0; round < 200; ++round) {
            std::vector<ChartDot> dots(1 + random() % 20);
            for (std::size_t i = 0; i < dots.size(); ++i) {
                const double error = random() % 9 == 0 ? 0 : power(4) * 1e-4;
                dots[i] = {"dot" + std::to_string(i) + ".", random() % 9 == 0 ? 0 : power(3), error, 0.5 * error,
                           1.5 * error};
            }
            const std::string svg = scatter_svg(chart(dots));
            REQUIRE(is_well_formed(svg));
            CHECK(svg == scatter_svg(chart(dots)));
            const Box p = plot(svg);
            for (const SvgPiece& dot : svg_all(svg, "circle")) {
                CHECK((dot.number("cx") > p.left && dot.number("cx") < p.right));
                CHECK((dot.number("cy") > p.top && dot.number("cy") < p.bottom));
            }
            for (const ChartDot& dot : dots)
                CHECK(contains(svg, ">" + dot.label + "</text>") != contains(svg, ">No room for: " + dot.label));
        }
    }

    TEST_CASE("scatter_svg: a limit is a line across at its error, inside the plot") {
        ScatterChart c = chart({{"a", 1, 0.1}, {"b", 10, 0.01}});
        const auto limit_of = [](const std::string& svg) {
            for (const SvgPiece& line : svg_all(svg, "line"))
                if (line.value("class") == "limit") return line.number("y1");
            return -1.0;
        };
        CHECK(limit_of(scatter_svg(c)) == -1);
        c.limit = 0.01;
        std::string svg = scatter_svg(c);
        CHECK(limit_of(svg) == doctest::Approx(svg_all(svg, "circle")[1].number("cy")));
        c.limit = 1e-5;
        svg = scatter_svg(c);
        CHECK(limit_of(svg) < plot(svg).bottom);
        CHECK(limit_of(svg) > svg_all(svg, "circle")[1].number("cy"));
        c.limit = std::numeric_limits<double>::infinity();
        CHECK(limit_of(scatter_svg(c)) == -1);
    }
}
