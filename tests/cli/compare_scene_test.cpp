// bake compare SCENE: the methods that show a relief, from outside.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A small torus with a height, and a ball with the same material beside it.
void write_scene(const Folder& folder) {
    fs::copy_file(own_meshes() / "dots.png", folder / "dots.png");
    write_file(folder / "s.toml", R"([render]
size = [48, 32]
[camera]
position = [0, 3, 4]
target = [0, 0, 0]
[[light]]
type = "directional"
from = [-1, 1, 1]
[[material]]
name = "studs"
height = {file = "dots.png", amplitude = 0.1}
[[mesh]]
name = "ring"
shape = "torus:R=1,r=0.4"
segments = 16
material = "studs"
[[mesh]]
name = "ball"
shape = "sphere:R=0.3"
segments = 16
material = "studs"
)");
}

/// A command line that takes little time.
std::vector<std::string> quick(std::vector<std::string> more = {}) {
    std::vector<std::string> line = {"compare", "s.toml", "--spp", "2", "--reference", "displace:4"};
    if (more.empty() || more.back() != "--json") line.push_back("--no-causes");
    line.insert(line.end(), more.begin(), more.end());
    return line;
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE(
        "compare SCENE: a row per method, the same numbers in JSON and CSV, and pictures and charts in the folder") {
        const Folder folder;
        write_scene(folder);
        const Run text =
            run_bake(folder, quick({"--methods", "plain,bump,displace:4", "-o", "out/", "--report", "all.html"}));
        CHECK(text.err == "");
        REQUIRE(text.code == 0);
        for (const char* part : {"ring, ball: the methods against true displacement", "48 x 32, 2 samples per pixel",
                                 "displace:4, ", "\n  plain ", "\n  bump ", "\n  displace:4 ", " 0.00/0.0"})
            CHECK_MESSAGE(has(text.out, part), std::string(part));
        for (const char* name :
             {"reference.png", "plain.png", "plain_error.png", "bump.png", "bump_error.png", "displace_4.png",
              "displace_4_error.png", "contact.png", "chart.svg", "chart_bytes.svg", "compare.csv", "compare.json"})
            CHECK_MESSAGE(fs::exists(folder.path / "out" / name), std::string(name));
        CHECK(read_image(folder / "out/plain.png").width() == 48);
        CHECK(has(contents(folder / "all.html"), "displace:4"));
        const auto json = nlohmann::json::parse(contents(folder / "out/compare.json"));
        REQUIRE(json["methods"].size() == 3);
        CHECK(json["methods"][1]["command"] == "bake compare s.toml --spp 2 --reference displace:4 --methods bump");
        CHECK(json["methods"][1]["object"]["rmse"]["value"].get<double>() > 0);
        // The method that is the reference itself, from the same samples.
        const auto& same = json["methods"][2];
        CHECK(same["object"]["rmse"]["value"] == 0);
        CHECK(same["frame"]["psnr"]["value"] == "inf");
        CHECK(same["object"]["ssim"]["value"] == 1);
        CHECK(same["object"]["flip"]["max"] == 0);
        CHECK(same["silhouette_px"]["max"] == 0);
        CHECK(same["normals_deg"]["max"] == 0);
        const std::string csv = contents(folder / "out/compare.csv");
        CHECK(lines(csv) == 4);
        const Run printed = run_bake(folder, quick({"--methods", "bump", "--csv"}));
        CHECK(lines(printed.out) == 2);
        const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
        CHECK(commas(printed.out.substr(0, printed.out.find('\n'))) * 2 == commas(printed.out));
    }

    TEST_CASE("compare SCENE: --object changes one mesh, and what else has its material stays as it is") {
        const Folder folder;
        write_scene(folder);
        const auto pixels_of = [&](const std::vector<std::string>& more) {
            std::vector<std::string> line = quick({"--methods", "plain", "--json"});
            line.insert(line.end(), more.begin(), more.end());
            return nlohmann::json::parse(run_bake(folder, line).out)["methods"][0]["object"]["pixels"].get<int>();
        };
        const int both = pixels_of({}), ring = pixels_of({"--object", "ring"}), ball = pixels_of({"--object", "ball"});
        CHECK(ball > 0);
        CHECK(ball < ring);
        CHECK(both >= ring);
        CHECK(both <= ring + ball);
        check_refused(folder, quick({"--object", "rign"}), 2, "did you mean \"ring\"?");
    }

    TEST_CASE("compare SCENE: limits are of every method, and exit 1") {
        const Folder folder;
        write_scene(folder);
        CHECK(run_bake(folder, quick({"--methods", "plain", "--limit", "rmse=0.0001"})).code == 1);
        CHECK(run_bake(folder, quick({"--methods", "plain", "--limit", "rmse=1", "--limit", "outline=50"})).code == 0);
        const Run over =
            run_bake(folder, quick({"--methods", "displace:4,plain", "--limit", "outline-max=0.01", "--json"}));
        CHECK(over.code == 1);
        const auto json = nlohmann::json::parse(over.out);
        CHECK(json["over_limit"] == true);
        REQUIRE(json["warnings"].size() == 1);
        CHECK(json["warnings"][0].get<std::string>().starts_with("plain: over the limit: outline-max is "));
    }

    TEST_CASE("compare SCENE: the reference is refined until that changes little, and it says what that took") {
        const Folder folder;
        write_scene(folder);
        const Run run =
            run_bake(folder, {"compare", "s.toml", "--spp", "4", "--methods", "plain", "--object", "ball", "--json"});
        REQUIRE(run.code == 0);
        const auto reference = nlohmann::json::parse(run.out)["reference"];
        CHECK(reference["refinements"].get<int>() >= 1);
        CHECK(has(reference["note"], "the last refinement changed it by less than"));
        CHECK(reference["change"]["value"].get<double>() >= 0);
        CHECK(reference["method"].get<std::string>().starts_with("displace:"));
    }

    TEST_CASE("compare SCENE: refusals name the option or the file, and leave no folder behind") {
        const Folder folder;
        write_scene(folder);
        write_file(folder / "plain.toml", "mesh = [{shape = \"sphere\"}]\n");
        const auto before = folder.names();
        check_refused(folder, {"compare", "plain.toml", "-o", "out"}, 4, "no mesh has a material with a height");
        check_refused(folder, quick({"--methods", "bumpy"}), 2, "--methods bumpy: is not a method");
        check_refused(folder, {"compare", "s.toml", "--reference", "bump"}, 2,
                      "--reference bump: shows no true relief");
        check_refused(folder, quick({"--limit", "distance=1"}), 2, "--limit distance: is not computed here");
        check_refused(folder, quick({"--metric", "flip"}), 2, "--metric: belongs to pictures");
        check_refused(folder, quick({"--normals"}), 2, "--normals: ");
        check_refused(folder, quick({"s.toml"}), 2, "leave the second file out");
        check_refused(folder, quick({"--csv", "--json"}), 2, "--csv: ");
        check_refused(folder, quick({"--camera", "top"}), 2, "--camera top: ");
        check_refused(folder, quick({"--report", "no/such/all.html"}), 5, "no/such/all.html: ");
        check_refused(folder, quick({"-o", "no/such/folder"}), 5, "no/such/folder: ");
        CHECK(folder.names() == before);
    }

    TEST_CASE("compare SCENE: the shares of the error by cause sum to 1, and --no-causes leaves them out") {
        const Folder folder;
        write_scene(folder);
        const Run run = run_bake(folder, quick({"--methods", "bump", "--json"}));
        REQUIRE(run.code == 0);
        const auto row = nlohmann::json::parse(run.out)["methods"][0];
        double sum = 0;
        for (const auto& share : row["shares"]) sum += share.get<double>();
        CHECK(row["shares"].size() == 5);
        CHECK(sum == doctest::Approx(1).epsilon(1e-9));
        CHECK(row["shares_of"]["mean_square"].get<double>() > 0);
        const Run without = run_bake(folder, quick({"--methods", "bump", "--no-causes", "--json"}));
        CHECK_FALSE(nlohmann::json::parse(without.out)["methods"][0].contains("shares"));
    }

    TEST_CASE("compare SCENE: Ctrl-C keeps the methods that were rendered, and exits with 130") {
        const Folder folder;
        write_scene(folder);
        // The last methods take longer than the test waits.
        const Run run =
            run_bake(folder,
                     {"compare", "s.toml", "--size", "400", "--spp", "64", "--reference", "displace:4", "--methods",
                      "plain,bump,exact,blinn,normal,plain,bump,exact,blinn,normal,"
                      "plain,bump,exact,blinn,normal,plain,bump,exact,blinn,normal",
                      "-o", "out"},
                     {.seconds = 100, .interrupt_after = 2});
        CHECK(run.code == 130);
        if (!fs::exists(folder.path / "out")) return; // stopped before the first method was done
        const auto json = nlohmann::json::parse(contents(folder / "out/compare.json"));
        CHECK(json["interrupted"] == true);
        CHECK(json["methods"].size() >= 1);
        CHECK(json["methods"].size() < 20);
    }
}
