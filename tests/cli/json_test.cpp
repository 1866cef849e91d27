// --json of every verb against docs/json, and what a refused run prints there.
#include "cli/command.h"
#include "folders.h"
#include <nlohmann/json.hpp>

using namespace bake::test;

namespace {

using Json = nlohmann::json;

std::string own(const std::string& name) { return (source_folder() / "meshes" / name).string(); }

/// Exit code of scripts/validate_json, whose faults become a message; 77 where its package is missing.
int validate(const Folder& folder, const std::string& verb, const std::vector<std::string>& files) {
    const fs::path schema = source_folder() / "docs/json" / (verb + ".schema.json");
    std::string command = "'" + (source_folder() / "scripts/validate_json").string() + "' '" + schema.string() + "'";
    for (const std::string& file : files) command += " '" + (folder / file) + "'";
    const int status = std::system((command + " 2>'" + (folder / "faults") + "'").c_str());
    const int code = WEXITSTATUS(status);
    if (code == 1) MESSAGE(contents(folder / "faults"));
    return code;
}

bool no_validator() { return std::system("/usr/bin/python3 -c 'import jsonschema' 2>/dev/null") != 0; }

struct Case {
    std::string verb;
    std::vector<std::vector<std::string>> runs;
};

const std::vector<Case>& cases() {
    static const std::string torus = own("torus.obj"), bricks = own("bricks.png"), dots = own("dots.png"),
                             studs = own("studs.toml"), px = own("sky_%s.png");
    static const std::vector<Case> all = {
        {"normal-map",
         {{bricks, "-o", "n.png", "--size", "32"},
          {torus, "--height", bricks, "-o", "t.exr", "--size", "32", "--method", "blinn"},
          {torus, "--high", torus, "-o", "h.png", "--size", "16"},
          {torus, "--bevel", "2%", "-o", "b.ktx2", "--size", "32", "--preview", "p.png", "--preview-size", "16"}}},
        {"bump-table", {{bricks, "-o", "b.exr"}, {bricks, "-o", "b.png", "--units", "world"}}},
        {"displace", {{torus, "--height", dots, "-o", "d.ply"}, {torus, "--height", dots, "-o", "e.obj", "--measure"}}},
        {"surface",
         {{torus, "-o", "s.ply"},
          {torus, "--maps", "normal,mean-curvature", "--maps-out", "m", "--size", "16"},
          {"--shape", "sphere", "-o", "p.ply", "--resolution", "8"}}},
        {"check",
         {{torus, bricks},
          {"n.png", "missing.png"},
          {"--brdf", "lambert"},
          {"--pair", bricks, "n.png"},
          {torus, "--height", bricks}}},
        {"cubemap",
         {{px, "-o", "sky.exr", "--size", "16"},
          {px, "-o", "i.exr", "--size", "8", "--irradiance", "sh:3"},
          {px, "-o", "u.hdr", "--size", "16", "--for", "unreal"}}},
        {"render", {{torus, "-o", "r.png", "--size", "16", "--spp", "1"}, {torus, "--size", "16", "--pixel", "8,8"}}},
        {"explain", {{torus, "--height", bricks, "--uv", "0.25,0.5"}}},
        {"compare",
         {{bricks, bricks}, {own("sky_px.png"), own("sky_nx.png")}, {torus, torus}, {"--normals", "n.png", "n.png"}}},
        {"batch",
         {{own("bakes.toml"), "--dry-run"},
          {own("bakes.toml"), "--emit", "openjd"},
          {own("bakes.toml"), "--emit", "ninja", "-o", "build.ninja"}}},
        {"plan", {{studs, "--size", "16"}}},
    };
    return all;
}

} // namespace

TEST_SUITE("cli" * doctest::skip(no_validator())) {

    TEST_CASE("--json: what every verb prints is what its schema in docs/json says") {
        const Folder folder;
        for (const Case& c : cases()) {
            CAPTURE(c.verb);
            std::vector<std::string> files;
            for (std::vector<std::string> words : c.runs) {
                words.insert(words.begin(), c.verb);
                words.push_back("--json");
                const Run run = run_bake(folder, words);
                CHECK_MESSAGE((run.code == 0 || (c.verb == "check" && run.code == 3)), run.err);
                files.push_back(c.verb + std::to_string(files.size()) + ".json");
                write_file(folder / files.back(), run.out);
                const Json json = Json::parse(run.out);
                CHECK(json["verb"] == c.verb);
                CHECK(json["argv"].size() == words.size() + 1);
                CHECK(json["exit_code"] == run.code);
            }
            CHECK(validate(folder, c.verb, files) == 0);
        }
    }

    TEST_CASE("--json: a refused run prints its reason and its code, wherever it was refused") {
        const Folder folder;
        write_file(folder / "cut.obj", "v 0 0 0\nf 1 2 3\n");
        const std::vector<std::vector<std::string>> refused = {
            {"normal-map", "missing.png", "-o", "n.png"},
            {"normal-map", own("bricks.png"), "-o", "n.png", "--amplitud", "1"},
            {"surface", "cut.obj", "-o", "s.ply"},
            {"bump-table", own("bricks.png"), "-o", "no/folder/b.exr"},
            {"bakee"},
        };
        std::vector<std::string> files;
        for (std::vector<std::string> words : refused) {
            words.push_back("--json");
            const Run run = run_bake(folder, words);
            CAPTURE(run.err);
            CHECK(run.code != 0);
            const Json json = Json::parse(run.out);
            CHECK(json["exit_code"] == run.code);
            CHECK("bake: " + json["error"].get<std::string>() + "\n" == run.err);
            CHECK(json["outputs"].empty());
            files.push_back("refused" + std::to_string(files.size()) + ".json");
            write_file(folder / files.back(), run.out);
        }
        CHECK(validate(folder, "run", files) == 0);
    }

    TEST_CASE(
        "--json: inputs and outputs are the files that were read and written, notes those that are printed without") {
        const Folder folder;
        const std::vector<std::string> words = {"normal-map", own("torus.obj"), "--height", own("bricks.png"),
                                                "-o",         "n.png",          "--size",   "32"};
        std::vector<std::string> with = words;
        with.push_back("--json");
        const Run json_run = run_bake(folder, with), text_run = run_bake(folder, words);
        const Json json = Json::parse(json_run.out);
        CHECK(json["outputs"] == Json::array({"n.png"}));
        REQUIRE(json["inputs"].size() == 2);
        CHECK(json["inputs"][0]["file"] == own("bricks.png"));
        CHECK(json["inputs"][1]["file"] == own("torus.obj"));
        CHECK(json_run.err.empty());
        std::string notes;
        for (const Json& line : json["notes"]) notes += "bake: " + line.get<std::string>() + "\n";
        CHECK(!notes.empty());
        CHECK(notes == text_run.err);
        double sum = 0;
        for (const auto& [step, seconds] : json["seconds"].items())
            if (step != "total") sum += seconds.get<double>();
        CHECK(json["seconds"]["total"].get<double>() == doctest::Approx(sum));
    }
}
