// bake plan from outside.
#include "bake/base/text.h"
#include "bake/preview/scene_io.h"
#include "bake/verdict/report/page_assets.h"
#include "cli/command.h"
#include "memory_limits.h"
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A ring and a ball with one material, small in the picture.
void write_scene(const Folder& folder) {
    fs::copy_file(own_meshes() / "dots.png", folder / "dots.png");
    write_file(folder / "s.toml", R"(# two objects
[render]
size = [32, 24]
spp = 4
exposure = 0
[[camera]]
name = "front"
position = [0, 3, 4]
target = [0, 0, 0]
[[camera]]
name = "top"
position = [0, 6, 0.1]
target = [0, 0, 0]
[[light]]
type = "directional"
from = [-1, 1, 1]
[[material]]
name = "studs"
height = {file = "dots.png", amplitude = 0.02} # high
[[mesh]]
name = "ring"
shape = "torus:R=1,r=0.4"
segments = [24, 12]
material = "studs"
[[mesh]]
name = "ball"
shape = "sphere:R=0.3"
segments = [12, 8]
material = "studs"
)");
}

std::vector<std::string> line(std::vector<std::string> more) {
    more.insert(more.begin(), {"plan", "s.toml"});
    return more;
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("plan: a row for each object, the same in JSON for any number of threads, and a scene that renders") {
        const Folder folder;
        write_scene(folder);
        const Run text = run_bake(folder, line({"--budget", "rmse=0.05", "--camera", "front", "-o", "planned.toml",
                                                "--manifest", "bakes.toml", "--threads", "2"}));
        CHECK(text.err == "");
        REQUIRE(text.code == 0);
        for (const char* part : {"within rmse 0.0500 (rmse=0.05)", "\n  ring  ", "\n  ball  ", "    why  ",
                                 "    saves  ", "front; the worst one counts", "planned.toml", "bakes.toml"})
            CHECK_MESSAGE(has(text.out, part), part << "\n" << text.out);
        const Run one = run_bake(
            folder, line({"--budget", "rmse=0.05", "--camera", "front", "--threads", "1", "--json", "-o", "one.toml"}));
        const auto json = nlohmann::json::parse(one.out);
        CHECK(contents(folder / "one.toml") == contents(folder / "planned.toml"));
        REQUIRE(json["objects"].size() == 2);
        const SceneEntries planned = read_scene(folder / "planned.toml");
        for (std::size_t i = 0; i < 2; ++i) {
            const auto& shade = planned.materials[std::size_t(planned.meshes[i].material)].relief.shade;
            CHECK(name(shade.value_or(ShadeMethod{Shade::exact})) == json["objects"][i]["model"]);
            const auto& object = json["objects"][i];
            if (object["chosen"].is_null()) continue;
            const double rmse = object["rungs"][object["chosen"].get<std::size_t>()]["error"]["rmse"];
            CHECK_MESSAGE(has(text.out, format(" %.4f ", rmse)), text.out);
        }
        CHECK(has(contents(folder / "planned.toml"), "# two objects\n"));
        CHECK(has(contents(folder / "bakes.toml"), "manifest = 1\n"));
        CHECK(run_bake(folder, {"render", "planned.toml", "-o", "planned.png", "--spp", "1"}).code == 0);
    }

    TEST_CASE("plan: an infinite budget allows the cheapest model, and --verify measures it") {
        const Folder folder;
        write_scene(folder);
        const Run run = run_bake(folder, line({"--budget", "rmse=inf", "--verify", "--json"}));
        REQUIRE(run.code == 0);
        const auto json = nlohmann::json::parse(run.out);
        CHECK(json["cameras"].size() == 2);
        for (const auto& object : json["objects"]) CHECK(object["model"] == "plain");
        REQUIRE(json["verified"].size() > 0);
        for (const auto& line : json["verified"]) CHECK(line["measured"]["rmse"].get<double>() > 0);
    }

    TEST_CASE("plan: sizes, sky and lights that were decided are in the planned scene") {
        const Folder folder;
        write_scene(folder);
        for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"}) {
            const std::string name = std::string("sky_") + face + ".png";
            fs::copy_file(own_meshes() / name, folder / name);
        }
        std::string scene = contents(folder / "s.toml") + "[sky]\nfaces = \"sky_%s.png\"\n";
        scene.replace(scene.find("# high"), 6, "\nshade = \"normal\"");
        write_file(folder / "s.toml", scene);
        // Nothing may be seen, so that each decision is the cheapest.
        const Run run = run_bake(folder, line({"--budget", "rmse=inf", "--decide", "texture,sky,lights", "-o", "p.toml",
                                               "--manifest", "b.toml", "--verify"}));
        REQUIRE_MESSAGE(run.code == 0, run.err);
        const SceneEntries planned = read_scene(folder / "p.toml");
        CHECK(planned.lights.empty());
        CHECK_FALSE(planned.settings.shadows);
        CHECK(planned.sky.reduction.sh_bands == 1);
        for (const MaterialEntry& material : planned.materials) CHECK(material.relief_size == 1);
        CHECK_MESSAGE(has(run.out, "sky: no command bakes its mean"), run.out);
        CHECK(run_bake(folder, {"render", "p.toml", "-o", "p.png", "--spp", "1"}).code == 0);
    }

    TEST_CASE("plan: a map as good as RGB8 is in BC5; the scene and the files of the manifest show it, and --verify "
              "measures it") {
        const Folder folder;
        write_scene(folder);
        std::string scene = contents(folder / "s.toml");
        scene.replace(scene.find("# high"), 6, "\nshade = \"normal\"");
        write_file(folder / "s.toml", scene);
        const Run run = run_bake(folder, line({"--camera", "front", "--decide", "texture,format", "--map-budget",
                                               "rgb8", "-o", "p.toml", "--manifest", "b.toml", "--verify", "--json"}));
        REQUIRE_MESSAGE(run.code == 0, run.err);
        const auto json = nlohmann::json::parse(run.out);
        REQUIRE(json["textures"].size() == 2);
        bool any = false;
        for (const auto& map : json["textures"]) {
            any |= map["bc5"].get<bool>();
            CHECK(map["error"]["rmse"].get<double>() <= map["rgb8_rmse"].get<double>());
        }
        CHECK(any);
        CHECK(has(contents(folder / "p.toml"), "normal-depth = \"bc5\"\n"));
        CHECK(has(contents(folder / "b.toml"), "depth = \"bc5\""));
        CHECK(has(contents(folder / "b.toml"), "_normal.ktx2"));
        REQUIRE(json["verified"].size() == 3); // two maps and the frame
        for (const auto& line : json["verified"]) CHECK(line["within"].get<bool>());
        CHECK(json["verified"][0]["predicted"]["rmse"] == json["textures"][0]["error"]["rmse"]);
        CHECK(run_bake(folder, {"render", "p.toml", "-o", "p.png", "--spp", "1"}).code == 0);
    }

    TEST_CASE("plan: --verify tells maps that are over the budget") {
        const Folder folder;
        write_scene(folder);
        std::string scene = contents(folder / "s.toml");
        scene.replace(scene.find("# high"), 6, "\nshade = \"normal\"");
        write_file(folder / "s.toml", scene);
        // Within 0 no form is: the finest one is taken, and errs by a little.
        const Run run = run_bake(
            folder, line({"--budget", "rmse=0", "--camera", "front", "--decide", "texture,format", "--verify"}));
        CHECK(run.code == 1);
        CHECK_MESSAGE(has(run.out, "OVER the budget"), run.out);
    }

    TEST_CASE(
        "plan: beside a reference that does not fit in memory it plans against the finest that does, and says so") {
        if (!keeps_memory_limits()) return;
        const Folder folder;
        write_scene(folder);
        const std::vector<std::string> words = line({"--budget", "rmse=0.0002", "--threads", "1", "--json"});
        const auto levels = [&](const Run& run) {
            REQUIRE(run.code == 0);
            return std::stoi(
                nlohmann::json::parse(run.out)["objects"][0]["reference"]["model"].get<std::string>().substr(9));
        };
        const Run all = run_bake(folder, words);
        const Run less = run_bake(folder, words, {.resources = {{RLIMIT_AS, 300LL << 20}}});
        CHECK_FALSE(has(all.out, "fits in memory"));
        CHECK(has(less.out, "the finest that fits in memory"));
        CHECK(levels(less) < levels(all));
    }

    TEST_CASE("plan: refusals name the option or the file, and leave nothing behind") {
        const Folder folder;
        write_scene(folder);
        write_file(folder / "flat.toml", "mesh = [{shape = \"sphere\"}]\n");
        const auto refused = [&](const std::vector<std::string>& more, int code, const std::string& named) {
            check_refused(folder, line(more), code, named);
        };
        refused({"--budget", "tiny"}, 2, "--budget tiny: is not a budget");
        refused({"--budget", "rmse=-1"}, 2, "--budget rmse=-1: ");
        refused({"--camera", "frnt"}, 2, "did you mean");
        refused({"--cost", "watts=1"}, 2, "--cost watts=1: ");
        refused({"--cost", "bytes=nan"}, 2, "--cost bytes nan: ");
        refused({"--cost", "bytes=0"}, 2, "--cost bytes=0: nothing costs anything");
        refused({"--decide", "objects"}, 2, "--decide objects: ");
        refused({"--map-budget", "rgb9"}, 2, "--map-budget");
        refused({"--map-budget", "rgb8"}, 2, "--map-budget rgb8: no map is decided");
        refused({"-o", "p.png"}, 2, "--out p.png: ");
        refused({"-o", "p.toml", "--manifest", "p.toml"}, 2, "--manifest p.toml: ");
        refused({"-o", "p.toml", "--report", "p.toml"}, 2, "--report p.toml: is --out too");
        refused({"--report", "p.toml", "--manifest", "p.toml"}, 2, "--report p.toml: is --manifest too");
        refused({"-o", "s.toml"}, 2, "s.toml: ");
        refused({"-o", "no/p.toml"}, 5, "no/p.toml: ");
        check_refused(folder, {"plan", "no.toml"}, 3, "no.toml: ");
        check_refused(folder, {"plan", "dots.png"}, 3, "dots.png: ");
    }

    TEST_CASE("plan: --report writes a page with decisions, pictures and the commands of the bakes" *
              doctest::skip(*page_template == 0)) {
        const Folder folder;
        write_scene(folder);
        const std::vector<std::string> more = {"--budget", "rmse=0.05", "--cost", "bytes=0.01", "--verify"};
        std::vector<std::string> reported = line(more);
        for (const char* word : {"--manifest", "bakes.toml", "--report", "plan.html"}) reported.push_back(word);
        const Run run = run_bake(folder, reported);
        CHECK(run.err == "");
        REQUIRE(run.code == 0);
        CHECK(has(run.out, "plan.html"));
        const std::string page = contents(folder / "plan.html");
        for (const char* part :
             {"<th scope=\"row\">ring</th>", "<th scope=\"row\">ball</th>", "<dt>why</dt>", "<section id=\"verified\">",
              "<section id=\"rungs\">", "(chosen)", "data-method=\"displaced in full\" data-view=\"1\"",
              "data-method=\"planned\" data-view=\"0\"", "data-method=\"everything bumped\" data-view=\"1\"",
              "<code>bake plan s.toml --budget rmse=0.05 --cost bytes=0.01 --verify --manifest bakes.toml --report "
              "plan.html</code>"})
            CHECK_MESSAGE(has(page, part), std::string(part));
        CHECK(has(contents(folder / "bakes.toml"), "[[bake]]") == has(page, "<code>bake displace "));
        // The page changes nothing in the plan, and is the same for any number of threads.
        reported.push_back("--threads"), reported.push_back("1");
        CHECK(run_bake(folder, reported).code == 0);
        CHECK(contents(folder / "plan.html") == page);
        const std::string plain = run_bake(folder, line(more)).out;
        CHECK(has(plain, "  verified"));
        CHECK(has(run.out, plain.substr(0, plain.find("  Errors are"))));
        // What cannot be written is refused before heights are read.
        write_file(folder / "lost.toml", "material = [{name = \"m\", height = \"lost.png\"}]\n"
                                         "mesh = [{shape = \"sphere\", material = \"m\"}]\n");
        check_refused(folder, {"plan", "lost.toml"}, 3, "lost.png: ");
        check_refused(folder, {"plan", "lost.toml", "--report", "no/such/plan.html"}, 5, "no/such/plan.html: ");
    }

    TEST_CASE("plan: Ctrl-C keeps the decisions that were made, and exits with 130") {
        const Folder folder;
        write_scene(folder);
        const Run run = run_bake(folder, line({"--size", "1500", "--budget", "rmse=0.001", "-o", "p.toml"}),
                                 {.seconds = 100, .interrupt_after = 0.7});
        CHECK(run.code == 130);
        CHECK(has(run.err, "interrupted"));
    }
}
