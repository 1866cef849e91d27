// The page of a plan: its tables, its charts, and what the viewer is given.
#include "bake/verdict/plan/plan_page.h"
#include "bake/verdict/plan/rung_chart.h"
#include "verdict/chart/svg_pieces.h"
#include "verdict/plan/hand_made_plan.h"
#include <doctest/doctest.h>
#include <limits>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
    return n;
}

std::string section(const PageParts& parts, const std::string& id) {
    for (const PageSection& one : parts.sections)
        if (one.id == id) return one.html;
    return "no section " + id;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("plan page: a row per object with error, interval, budget, costs and savings, and the reasons below it") {
        const std::string table = decision_table(small_plan());
        CHECK(has(table, "<th scope=\"row\">ring</th><td class=\"model\">bump</td><td>0.0080</td><td>0.0072 to "
                         "0.0088</td><td>0.0100</td><td>2000</td><td>0.008</td><td>0.25</td><td>8.19 M</td>"
                         "<td>899.600</td><td>5</td><td>0.002</td></tr>"));
        CHECK(has(table, "<dt>why</dt><dd>bump is enough</dd>"));
        CHECK(has(table, "<dt>worst view</dt><dd>front, 500 pixels; mean flip 0.0160</dd>"));
        CHECK(has(table, "<dt>cheaper</dt><dd>roughness: skipped; 2000 triangles"));
        CHECK(has(table, "<dt>dearer</dt><dd>displace:4: rmse 0.0020 (0.0018 to 0.0022); 32000 triangles"));
        CHECK_FALSE(has(table, "not settled"));
        CHECK_FALSE(has(table, "<tfoot>"));
        CHECK(decision_table({}) == "");
        // As many columns in each row.
        CHECK(count(table, "colspan=\"12\"") == 1);
        CHECK(count(table.substr(table.find("<tbody>"), table.find("</tr>", table.find("<tbody>"))), "<td") >= 11);
    }

    TEST_CASE(
        "plan page: what is not settled is marked, the reference is chosen if nothing else is, and costs add up") {
        ScenePlan plan = small_plan();
        plan.objects.push_back(plan.objects[0]);
        plan.objects[0].rungs[2].known = Known::not_settled;
        plan.objects[1].chosen = -1;
        const std::string table = decision_table(plan);
        CHECK(has(table, "<dt>not settled</dt>"));
        CHECK(has(table, "<td class=\"model\">displace:64</td><td>0</td><td>the reference</td>"));
        CHECK(has(table, "<td>8.19 M</td><td>0.000</td><td>5.25</td><td>0</td>")); // costs of the reference, 0 saved
        const std::string sum = table.substr(table.find("<tfoot>"));
        CHECK(has(sum, "<td>8.19 M</td><td>0.008</td><td></td><td>8.19 M</td><td>899.600</td>"));
    }

    TEST_CASE("plan page: names are text in HTML") {
        ScenePlan plan = small_plan();
        plan.objects[0].object = "<b>&\"ring\"", plan.objects[0].why = "<i>";
        plan.objects[0].rungs[2].camera = "<u>";
        plan.cameras = {"<s>"};
        plan.notes = {"<em>"};
        plan.textures.push_back({.file = "<tt>.png", .kind = "normal", .why = "<big>"});
        plan.lights.push_back({.why = "<small>"});
        plan.verified.push_back({.camera = "<q>", .object = "<a>", .predicted = {}, .measured = {}});
        Bake bake;
        bake.name = "<p>", bake.verb = "bump-table", bake.files = {"it's <new>.png"};
        const PageParts parts = plan_page(plan, {"<x>.toml", "bake plan '<x>.toml'", {{bake}, {}}, "<folder>"});
        CHECK(parts.title == "<x>.toml \u00b7 bake plan"); // page_of() escapes it
        std::string html = parts.heading + parts.facts;
        for (const PageSection& one : parts.sections) html += one.html;
        for (const char* tag : {"<b>", "<i>", "<u>", "<s>", "<em>", "<tt>", "<big>", "<small>", "<q>", "<a>", "<new>",
                                "<p>", "<x>", "<folder>"})
            CHECK_MESSAGE(!has(html, tag), std::string(tag));
        CHECK(has(html, "&lt;b&gt;&amp;&quot;ring&quot;"));
        CHECK(has(section(parts, "commands"), "bake bump-table &#39;it&#39;\\&#39;&#39;s &lt;new&gt;.png&#39;"));
    }

    TEST_CASE("plan page: verification, textures, sky, lights, notes and commands have their sections") {
        ScenePlan plan = small_plan();
        CHECK(verification_table(plan) == "");
        CHECK(part_table(plan) == "");
        plan.verified.push_back({.camera = "top", .object = "", .predicted = {}, .measured = {.square = 1e-4}});
        plan.verified.push_back({.camera = "top", .object = "ring", .predicted = {}, .measured = {}, .within = true});
        plan.textures.push_back({.file = "a.png", .kind = "normal", .width = 64, .height = 32, .why = "w"});
        plan.sky = SkyPlan{.model = "faces", .face = 32, .levels = 3, .why = "s"};
        plan.lights.push_back({.light = 1, .keep = true, .shadows = false});
        plan.over_budget = true;
        plan.notes = {"a note"};
        const PageParts parts = plan_page(plan, {"s.toml", "bake plan s.toml", {}, "."});
        CHECK(has(section(parts, "verified"), "<td>(whole picture)</td><td>\u2013</td><td>0.0100 (0.0100 to "
                                              "0.0100)</td><td>0</td><td class=\"over\">over the budget</td>"));
        CHECK(has(section(parts, "verified"), "<td>within</td>"));
        CHECK(has(section(parts, "parts"), "<th scope=\"row\">texture</th><td>a.png, normal: 64 x 32"));
        CHECK(has(section(parts, "parts"), "faces: faces of 32, 3 levels"));
        CHECK(has(section(parts, "parts"), "<th scope=\"row\">light 2</th><td>stays, without shadows"));
        CHECK(has(section(parts, "notes"), "<li>over the budget</li>\n<li>a note</li>"));
        CHECK(has(section(parts, "commands"), "<code>bake plan s.toml</code>"));
        CHECK(has(parts.facts, "<dt>budget</dt><dd>rmse 0.0100 (normal)</dd>"));
        CHECK(has(parts.facts, "<dt>cameras</dt><dd>front, top; the worst one counts</dd>"));
    }

    TEST_CASE("plan page: each camera is a view with the reference first and the errors of the others") {
        ScenePlan plan = small_plan();
        add_pictures(plan);
        const PageParts parts = plan_page(plan, {"s.toml", "", {}, "."});
        REQUIRE(parts.pictures.size() == 6);
        const auto data = nlohmann::json::parse(parts.data);
        REQUIRE(data["views"].size() == 2);
        for (std::size_t k = 0; k < 2; ++k) {
            const auto& view = data["views"][k];
            CHECK(view["camera"] == plan.cameras[k]);
            CHECK(view["reference"]["method"] == "displaced in full");
            REQUIRE(view["methods"].size() == 2);
            CHECK(view["methods"][0]["method"] == data["first"]);
            // 0.1 over one half of the pixels, and 0.2 over all.
            CHECK(view["methods"][0]["frame"]["rmse"]["value"] == doctest::Approx(0.1 / std::sqrt(2.0)));
            CHECK(view["methods"][1]["frame"]["rmse"]["value"] == doctest::Approx(0.2));
            CHECK(view["methods"][0]["frame"]["flip"]["mean"] < view["methods"][1]["frame"]["flip"]["mean"]);
            CHECK(view["methods"][0]["worst"]["x"] < 24);
            for (std::size_t i = 0; i < 3; ++i) CHECK(parts.pictures[3 * k + i].view == int(k));
            CHECK(parts.pictures[3 * k].errors.empty());
            CHECK(parts.pictures[3 * k + 1].picture.at(0, 0) == doctest::Approx(0.2 + 0.3 * double(k)));
        }
        const std::string tables = section(parts, "tables");
        CHECK(count(tables, "<tr data-method=") == 4);
        CHECK(has(tables, "<div data-view=\"1\"><h3>top</h3>"));
        CHECK_FALSE(has(tables, "over the object"));
        CHECK(plan_page(small_plan(), {}).pictures.empty());
    }

    TEST_CASE("rung_chart: a dot for each error that is known and for the reference, and the budget as a line") {
        ScenePlan plan = small_plan();
        ObjectPlan& object = plan.objects[0];
        object.rungs[3].known = Known::bound, object.rungs[3].bound = 0.004;
        object.reference_error = 0.001;
        const std::string svg = rung_chart(plan, object);
        REQUIRE(is_well_formed(svg));
        CHECK(svg_all(svg, "circle").size() == 4); // plain, bump, displace:4, reference
        CHECK(count(svg, "class=\"limit\"") == 1);
        CHECK(has(svg, ">bump (chosen)</text>"));
        CHECK(has(svg, "displace:4, at most: cost: triangles + 0.01 x bytes of textures: 3.208e4; rmse: 0.004"));
        CHECK(has(svg, "displace:64 (reference): "));
        object.chosen = -1;
        CHECK(has(rung_chart(plan, object), "displace:64 (reference, chosen): "));
        object.budget = std::numeric_limits<double>::infinity();
        CHECK_FALSE(has(rung_chart(plan, object), "class=\"limit\""));
        object.reference_cost = {}; // not built
        CHECK(svg_all(rung_chart(plan, object), "circle").size() == 3);
        CHECK_FALSE(has(rung_chart(plan, object), "(reference"));
        for (Rung& rung : object.rungs) rung.known = Known::not_tried;
        CHECK(rung_chart(plan, object) == "");
    }

    TEST_CASE("plan page: up to 12 charts are open, more are behind a click") {
        ScenePlan plan = small_plan();
        while (plan.objects.size() < 12) plan.objects.push_back(plan.objects[0]);
        CHECK(count(rung_charts(plan), "<figure><svg") == 12);
        CHECK_FALSE(has(rung_charts(plan), "<details>"));
        plan.objects.push_back(plan.objects[0]);
        CHECK(has(rung_charts(plan), "<details><summary>13 objects</summary>"));
    }
}
