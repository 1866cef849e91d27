#include "bake/base/base64.h"
#include "bake/base/error.h"
#include "bake/picture/webp.h"
#include "bake/verdict/plan/plan_page.h"
#include "bake/verdict/report/page_assets.h"
#include "bake/verdict/report/page_tables.h"
#include "browser.h"
#include "cli/command.h"
#include "verdict/plan/hand_made_plan.h"
#include "verdict/report/little_report.h"
#include <cmath>
#include <sys/wait.h>

using namespace bake;
using namespace bake::test;
using Json = nlohmann::ordered_json;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
    return n;
}

bool no_page() { return *page_template == 0; }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE(
        "report: tables have a row per method, the best value of a column marked, and no columns without values") {
        const Json report = report_json();
        const std::string tables = error_tables(report);
        CHECK(count(tables, "<tr data-method=") == 20); // over the object and over the frame
        CHECK(tables.find("HDR-FLIP") == std::string::npos);
        CHECK(tables.find("<td class=\"best\">0.02 <small>±0.001</small></td>") != std::string::npos);
        CHECK(count(tables, "<td class=\"best\">∞</td>") == 2);
        CHECK(count(tables, ">95 %") == 0);                             // what titles mean stays in their attributes
        CHECK(tables.find("1\u2009234\u2009567") != std::string::npos); // equal triangles: none is best
        CHECK(count(tables, "class=\"best\">1\u2009234") == 0);
        CHECK(tables.find("<td>–</td>") != std::string::npos); // the last method has no costs
    }

    TEST_CASE("report: bars of shares are as long as the shares and lie side by side, negative ones left of 0") {
        const std::string bars = share_bars(report_json());
        // 110 % of positive shares and 10 % of negative ones fill the width.
        CHECK(count(bars, "class=\"cause0\" style=\"left:8.333%;width:41.667%\"") == 10);
        CHECK(count(bars, "class=\"cause1\" style=\"left:50.000%;width:20.833%\"") == 10);
        CHECK(count(bars, "class=\"cause5\" style=\"left:0.000%;width:8.333%\"") == 10);
        CHECK(share_bars(Json::object()) == "");
    }

    TEST_CASE("report: text is safe in HTML, and commands are whole") {
        CHECK(heading({{"object", "<b>"}, {"scene", "a&b"}}) == "&lt;b&gt; <span>in a&amp;b</span>");
        const std::string list = commands(report_json());
        CHECK(count(list, "<li ") == 11);
        CHECK(list.find("--methods &#39;&lt;b&gt;&amp;&quot;blinn&quot;&#39;</code>") != std::string::npos);
    }

    TEST_CASE("report: without errors over an object there is one table, of the frame") {
        Json report = report_json();
        for (Json& row : report["methods"]) row.erase("object");
        const std::string tables = error_tables(report);
        CHECK(count(tables, "<table>") == 1);
        CHECK(count(tables, "<tr data-method=") == 10);
        CHECK(tables.find(">triangles</th>") != std::string::npos);
    }

    TEST_CASE("report: a list of commands leaves out empty ones") {
        CHECK(command_list({}) == "");
        CHECK(command_list({{"a", "", "bake <x>"}, {"b", "m", ""}, {"<i>c</i>", "m", "bake y"}}) ==
              "<ol>\n<li data-method=\"\"><span>a</span><code>bake &lt;x&gt;</code></li>\n"
              "<li data-method=\"m\"><span><i>c</i></span><code>bake y</code></li>\n</ol>\n");
    }

    TEST_CASE("report: words of commands are quoted where a shell would take them apart") {
        CHECK(shell_word("--height=a_b-1.5%/x.png") == "--height=a_b-1.5%/x.png");
        CHECK(shell_word("") == "''");
        CHECK(shell_word("a b") == "'a b'");
        CHECK(shell_word("it's $x") == "'it'\\''s $x'");
    }

    TEST_CASE("base64: the vectors of RFC 4648") {
        CHECK(base64("") == "");
        CHECK(base64("f") == "Zg==");
        CHECK(base64("fo") == "Zm8=");
        CHECK(base64("foo") == "Zm9v");
        CHECK(base64("foobar") == "Zm9vYmFy");
        CHECK(base64("\xff\xfe\xfd") == "//79");
    }
}

TEST_SUITE("unit" * doctest::skip(no_page())) {

    TEST_CASE("report: a page without a method, a picture or anything else") {
        for (const char* json : {"{}", "{\"methods\":[{}]}", "{\"methods\":3,\"reference\":[],\"exposure\":\"x\"}"}) {
            const std::string page = report_page(json, {});
            CHECK(page.find("{{") == std::string::npos);
            CHECK(page.find("<figure data-method") == std::string::npos);
        }
    }

    TEST_CASE("report: the page holds every picture, and no end of a script from a name") {
        Json report = report_json();
        report["methods"][0]["method"] = "</script><!--";
        const std::string page = report_page(report.dump(), report_pictures());
        CHECK(count(page, "<img class=\"shown\"") == 11);
        CHECK(count(page, "<img class=\"errors\"") == 10);
        CHECK(count(page, "</script>") == 3);
        CHECK(page.find("<!--") == std::string::npos);
        CHECK(count(page, "http") == count(page, "http-equiv") + count(page, "http://www.w3.org"));
    }

    TEST_CASE("report: a page of several cameras numbers the pictures of each, and has the sections that have text") {
        PageParts parts{.title = "<t>",
                        .heading = "<i>h</i>",
                        .facts = "",
                        .sections = {{"one", "One", "<p>text</p>\n"}, {"two", "Two", ""}},
                        .data = R"({"views": [{"camera": "<front>"}, {"camera": "top"}]})",
                        .pictures = {}};
        for (int view = 0; view < 2; ++view)
            for (const char* method : {"a", "b"}) parts.pictures.push_back({method, Image<float>(4, 3, 3), {}, view});
        const std::string page = page_of(parts);
        CHECK(page.find("<title>&lt;t&gt;</title>") != std::string::npos);
        CHECK(count(page, "<section id=\"one\">\n<h2>One</h2>\n<p>text</p>") == 1);
        CHECK(count(page, "<section id=\"two\">") == 0);
        CHECK(count(page, "data-method=\"b\" data-view=\"1\"") == 1);
        CHECK(count(page, "<kbd>0</kbd> <b>a</b> reference") == 2);
        CHECK(count(page, "<span class=\"camera\">&lt;front&gt;</span> <kbd>1</kbd> <b>b</b>") == 1);
        CHECK(count(page, "<img class=\"shown\" alt=\"b\" width=\"4\" height=\"3\"") == 2);
    }
}

TEST_SUITE("cli" * doctest::skip(no_browser() || no_page())) {

    TEST_CASE("report: every control of the page, in a browser") {
        const Folder folder;
        Json job = {{"methods", Json::array({"displace:256"})}, {"exposure", report_exposure}, {"red", Json::array()}};
        for (const std::string& name : report_methods()) job["methods"].push_back(name);
        for (std::size_t i = 0; i <= report_methods().size(); ++i) job["red"].push_back(square_red(i));
        write_file(folder / "job.json", job.dump());
        write_file(folder / "report.html", report_page(report_json().dump(), report_pictures()));
        write_file(folder / "bare.html", report_page("{}", {}));
        ScenePlan plan = small_plan();
        add_pictures(plan);
        write_file(folder / "plan.html", page_of(plan_page(plan, {"s.toml", "bake plan s.toml", {}, "."})));
        const std::string log = folder / "log";
        const int status = std::system(("'" + (source_folder() / "scripts/three_viewer").string() + "' --run '" +
                                        (source_folder() / "tests/verdict/report/report_page.mjs").string() + "' '" +
                                        folder.path.string() + "' >'" + log + "' 2>&1")
                                           .c_str());
        REQUIRE_MESSAGE((WIFEXITED(status) && WEXITSTATUS(status) == 0), contents(log));
        MESSAGE(contents(log));
    }
}
