// bake explain: the whole route of one texel, as a golden text.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

using namespace bake;
using namespace bake::test;

namespace {

/// In a folder from which the project's meshes/ are seen under that name.
struct Project : Folder {
    Project() { fs::create_directory_symlink(own_meshes(), path / "meshes"); }
};

std::vector<std::string> explain(const std::string& uv, std::vector<std::string> more = {}) {
    more.insert(more.begin(),
                {"explain", "meshes/torus.obj", "--height", "meshes/bricks.png", "--amplitude", "1%", "--uv", uv});
    return more;
}

/// Numbers equal to a few units in their fifth digit (other machines round elsewhere), all other words equal.
bool same_word(const std::string& a, const std::string& b) {
    char *end_a, *end_b;
    const double x = std::strtod(a.c_str(), &end_a), y = std::strtod(b.c_str(), &end_b);
    if (*end_a || *end_b) return a == b;
    return std::abs(x - y) <= 1e-4 * std::abs(y) + 2e-5;
}

/// Line by line and word by word.
void check_same_text(const std::string& text, const std::string& wanted_text) {
    std::istringstream lines(text), golden(wanted_text);
    std::string line, expected;
    while (std::getline(golden, expected)) {
        REQUIRE(std::getline(lines, line));
        std::istringstream words(line), wanted(expected);
        for (std::string word, other; wanted >> other;) {
            REQUIRE_MESSAGE((words >> word), line << " instead of " << expected);
            CHECK_MESSAGE(same_word(word, other), line << " instead of " << expected);
        }
    }
    CHECK_FALSE(std::getline(lines, line));
}

/// docs/route.md: its command, what it quotes of the command's output, and the rest.
struct RoutePage {
    std::string command, quoted, prose;
};

RoutePage read_route_page() {
    std::istringstream lines(contents((source_folder() / "docs/route.md").string()));
    RoutePage page;
    std::string block;
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```")) {
            const std::string first = block.substr(0, block.find('\n'));
            if (first.starts_with("bake explain ")) page.command = first;
            else if (first.substr(0, first.find(' ')).ends_with(":")) page.quoted += block; // a step's heading
            block.clear();
            inside = !inside;
        } else {
            (inside ? block : page.prose) += line + "\n";
        }
    }
    return page;
}

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("explain: the route of a texel of the torus with bricks is the golden one") {
        // When the route is meant to change: bake explain meshes/torus.obj --height meshes/bricks.png --amplitude 1%
        // --uv 0.3,0.6 > tests/cli/explain_golden.txt
        const Project folder;
        const Run run = run_bake(folder, explain("0.3,0.6"));
        REQUIRE_MESSAGE(run.code == 0, run.err);
        CHECK(run.err == "");
        check_same_text(run.out, contents((source_folder() / "tests/cli/explain_golden.txt").string()));
    }

    TEST_CASE("explain: the numbers of docs/route.md are what its command prints") {
        const Project folder;
        const RoutePage page = read_route_page();
        const std::vector<std::string> words = words_of(page.command);
        REQUIRE(words.size() > 2);
        const Run run = run_bake(folder, {words.begin() + 1, words.end()});
        REQUIRE_MESSAGE(run.code == 0, run.err);
        check_same_text(run.out, page.quoted);
        // Numbers of five decimals and more that the text around the quotes repeats.
        int repeated = 0;
        const std::regex number("-?[0-9]+\\.[0-9]{5,}");
        for (std::sregex_iterator at(page.prose.begin(), page.prose.end(), number), end; at != end; ++at, ++repeated)
            CHECK_MESSAGE(page.quoted.find(" " + at->str()) != std::string::npos, at->str());
        CHECK(repeated > 4);
    }

    TEST_CASE("explain: --json holds the same steps in the order of the route") {
        const Project folder;
        const Run run = run_bake(folder, explain("0.3,0.6", {"--json"}));
        REQUIRE(run.code == 0);
        const auto route = nlohmann::json::parse(run.out)["route"];
        const char* steps[] = {"image_io",      "height",     "mesh_surface", "displaced_normal",
                               "tangent_space", "normal_map", "bsdf"};
        REQUIRE(route.size() == 7);
        for (std::size_t i = 0; i < 7; ++i) {
            CHECK(route[i].dump().find(steps[i]) != std::string::npos);
            for (const auto& entry : route[i]["entries"])
                for (const auto& value : entry["values"]) CHECK(value.is_number()); // a NaN would be null
        }
    }

    TEST_CASE("explain: what it prints is what normal-map bakes there") {
        const Project folder;
        REQUIRE(run_bake(folder, {"normal-map", "meshes/torus.obj", "--height", "meshes/bricks.png", "--amplitude",
                                  "1%", "-o", "n.exr", "--depth", "float", "--size", "128x64"})
                    .code == 0);
        const Image<float> map = read_image(folder / "n.exr");
        for (const auto& [uv, x, y] :
             {std::tuple("0.3,0.6", 38, 25), {"0,1", 0, 0}, {"1,0", 127, 63}, {"0.5,0.5", 64, 32}}) {
            CAPTURE(std::string(uv));
            const Run run = run_bake(folder, explain(uv, {"--json", "--size", "128x64"}));
            REQUIRE_MESSAGE(run.code == 0, run.err);
            bool found = false;
            const auto object = nlohmann::json::parse(run.out);
            for (const auto& step : object["route"])
                for (const auto& entry : step["entries"])
                    if (entry["name"] == "rgb") {
                        found = true;
                        for (int c = 0; c < 3; ++c)
                            CHECK(entry["values"][c].get<double>() == doctest::Approx(map.at(x, y, c)).epsilon(1e-6));
                    }
            CHECK(found);
        }
    }

    TEST_CASE("explain: a place outside every chart is said to be so, without a normal made up") {
        const Project folder;
        write_file(folder / "corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 0.25 0\nvt 0 0.25\nf 1/1 2/2 3/3\n");
        const auto at = [&](const char* uv) {
            const Run run = run_bake(
                folder, {"explain", "corner.obj", "--height", "meshes/dots.png", "--amplitude", "1%", "--uv", uv});
            CHECK(run.code == 0);
            return run.out;
        };
        CHECK(at("0.9,0.9").find("no face covers this texel") != std::string::npos);
        CHECK(at("0.9,0.9").find("rgb") == std::string::npos);
        CHECK(at("0.1,0.1").find("rgb") != std::string::npos);
    }

} // TEST_SUITE
