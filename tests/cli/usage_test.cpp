// The command line itself: what is refused before anything is read.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

using namespace bake;
using namespace bake::test;

namespace {

const std::string dots = (own_meshes() / "dots.png").string(), torus = (own_meshes() / "torus.obj").string();

} // namespace

TEST_SUITE("cli") {

    TEST_CASE(
        "usage: help and version are exit 0 on stdout; every verb's help has examples and no path of this machine") {
        const Folder folder;
        const Run version = run_bake(folder, {"--version"});
        CHECK(version.code == 0);
        CHECK(std::regex_search(version.out,
                                std::regex("^bake [0-9.]+ \\(commit ([0-9a-f]{10}(-modified)?|unknown)\\)\n")));
        CHECK(std::regex_search(version.out, std::regex("\nLicence: (GPL-3.0-or-later|Apache-2.0)")));
        CHECK(std::regex_search(version.out, std::regex("\nBuilt with .*OpenImageIO 2[0-9.]+, ")));
        CHECK(lines(version.out) == 3);
        std::vector<std::vector<std::string>> calls = {{"--help"}, {"explain", "-h"}};
        for (const std::string& verb : verbs()) calls.push_back({verb, "--help"});
        REQUIRE(calls.size() >= 10); // eight verbs
        // A verb that nobody lists does not exist.
        for (const auto& file : fs::directory_iterator(own_meshes().parent_path() / "tools/bake")) {
            std::string name = file.path().filename().string();
            if (!name.ends_with("_verb.cpp")) continue;
            name.resize(name.size() - std::string("_verb.cpp").size());
            std::replace(name.begin(), name.end(), '_', '-');
            CAPTURE(name);
            const std::vector<std::string> all = verbs();
            CHECK(std::find(all.begin(), all.end(), name) != all.end());
        }
        std::string general; // what a verb without examples of its own would show
        for (const std::vector<std::string>& arguments : calls) {
            const Run help = run_bake(folder, arguments);
            CHECK(help.code == 0);
            CHECK(help.err == "");
            const std::size_t examples = help.out.find("Examples:\n  bake ");
            REQUIRE(examples != std::string::npos);
            const std::string own = help.out.substr(examples);
            if (arguments[0] == "--help") general = own;
            else CHECK_MESSAGE(own != general, "add_examples() is missing in " << arguments[0]);
            CHECK(help.out.find("Usage: bake ") != std::string::npos);
        }
        const Run help = run_bake(folder, {"bump-table", "--help"});
        for (const char* option : {"--filter", "--wrap", "--wrap-u", "--wrap-v", "--units", "--amplitude", "--extent",
                                   "--channel", "--invert", "--layout", "--depth", "--dequantise", "--threads",
                                   "--quiet", "--json", "auto|central|sobel|scharr|order4|order6|c2"})
            CHECK_MESSAGE(help.out.find(option) != std::string::npos, std::string(option));
    }

    TEST_CASE("usage: every example of every --help runs beside meshes/") {
        const Folder folder;
        fs::create_directory_symlink(own_meshes(), folder.path / "meshes");
        const std::string environment = "cd '" + folder.path.string() + "' && PATH='" +
                                        fs::path(std::getenv("BAKE")).parent_path().string() + "':$PATH ";
        std::vector<std::vector<std::string>> helps = {{"--help"}};
        for (const std::string& verb : verbs()) helps.push_back({verb, "--help"});
        int run = 0;
        for (const std::vector<std::string>& arguments : helps) {
            const std::string help = run_bake(folder, arguments).out;
            std::istringstream text(help.substr(help.find("Examples:\n")));
            for (std::string line; std::getline(text, line);) {
                if (!line.starts_with("  bake ") && !line.starts_with("  echo ")) continue;
                write_file(folder / "example", line);
                CHECK_MESSAGE(std::system((environment + "sh example >said 2>&1").c_str()) == 0,
                              line << ": " << contents(folder / "said"));
                ++run;
            }
        }
        CHECK(run >= 35);
    }

    TEST_CASE("usage: every verb has its page in docs, and the README links to it") {
        const std::string readme = contents((own_meshes() / "../README.md").string());
        for (const std::string& verb : verbs()) {
            const std::string page = "docs/" + verb + ".md";
            CHECK_MESSAGE(fs::exists(own_meshes() / ".." / page), page << " is missing");
            CHECK_MESSAGE(readme.find("(" + page + ")") != std::string::npos, "README.md has no link to " << page);
        }
    }

    TEST_CASE("usage: messages of the library name fields of its options, and the command turns them into flags") {
        const fs::path sources = own_meshes() / "../libbake";
        for (const auto& entry : fs::recursive_directory_iterator(sources)) {
            std::istringstream text(entry.is_regular_file() ? contents(entry.path().string()) : "");
            for (std::string line; std::getline(text, line);)
                for (std::size_t at = line.find("--"); at != std::string::npos; at = line.find("--", at + 2)) {
                    const bool quoted = std::count(line.begin(), line.begin() + std::ptrdiff_t(at), '"') % 2 == 1;
                    CHECK_MESSAGE(!(quoted && std::isalpha(static_cast<unsigned char>(line[at + 2]))),
                                  entry.path().string() << ": " << line);
                }
        }
        const Folder folder;
        fs::copy_file(dots, folder / "square.png");
        check_refused(folder, {"cubemap", "square.png", "-o", "a.exr"}, 4,
                      "name one of these formats in --from: ball, probe, octahedral");
        check_refused(folder, {"bump-table", "square.png", "--channel", "a", "-o", "a.exr"}, 4, "another --channel");
        check_refused(folder,
                      {"displace", torus, "--height", dots, "--levels", "6", "--max-memory", "700M", "-o", "a.ply"}, 4,
                      "raise --max-memory, or set --levels to 5");
        const Run check = run_bake(folder, {"check", (own_meshes() / "trouble/mirrored_uvs.obj").string(), "--json"});
        CHECK(check.out.find('`') == std::string::npos);
    }

    TEST_CASE("usage: wrong options are exit 2, one line that names them, and nothing is written") {
        const Folder folder;
        const auto refused = [&](const std::vector<std::string>& arguments, const std::string& named) {
            check_refused(folder, arguments, 2, named);
        };
        refused({"nosuch"}, "nosuch: is not a verb; see bake --help");
        refused({""}, "argument 1: is empty");
        refused({"Normal-Map"}, "Normal-Map: is not a verb (did you mean normal-map?)");
        refused({"--nosuch"}, "--help");
        const auto map = [&](std::vector<std::string> more, const std::string& named) {
            more.insert(more.begin(), {"normal-map", "--height", dots});
            refused(more, named);
        };
        map({"-o", "a.png", "--nosuch"}, "--nosuch");
        map({}, "--out");
        map({"-o"}, "--out");
        map({"-o", ""}, "-o: is empty");
        map({"-o", "a"}, "ending");
        map({"-o", "a.jpg"}, "a.jpg");
        map({"-o", "a.png", "--depth", "half"}, "half");
        map({"-o", "a.png", "--depth", "float"}, "float");
        map({"-o", "a.exr", "--depth", "8"}, "a.exr");
        map({"-o", "a.exr", "--depth", "16"}, "a.exr");
        map({"-o", "a.exr", "--depth", "12"}, "--depth");
        map({"-o", "a.png", "--method", "best"}, "--method");
        map({"-o", "a.png", "--filter", "SOBEL"}, "--filter");
        map({"-o", "a.png", "--wrap", ""}, "--wrap");
        map({"-o", "a.png", "--channel", "x"}, "--channel");
        map({"-o", "a.png", "--padding", "-1"}, "--padding");
        map({"-o", "a.png", "--threads", "-1"}, "--threads");
        map({"-o", "a.png", "--space", "object"}, "--space");
        map({"-o", "a.png", "--midlevel", "nan"}, "--midlevel");
        map({"-o", "a.png", "--midlevel", "inf"}, "--midlevel");
        map({"-o", "a.png", "--midlevel", "half"}, "--midlevel");
        for (const char* size : {"0", "-4", "x", "10x", "x10", "3.5", "10x10x10", "65537", "1e9", "nan", "", "16 16"})
            map({"-o", "a.png", "--size", size}, "--size");
        for (const char* amplitude : {"nan", "inf", "1,5", "", "%", "one", "1%%", "1 %", "1e13", "0x"})
            map({"-o", "a.png", "--amplitude", amplitude}, "--amplitude");
        for (const char* extent : {"0,1", "1,0", "-1,1", "1", "1,", ",1", "1,1,1", "nan,1", "inf,1", "", "1e-300,1"})
            map({"-o", "a.png", "--extent", extent}, "--extent");
        map({"-o", "a.png", "--amplitude", "1e3", "--extent", "1e-9,1e-9"}, "--amplitude");
        refused({"normal-map", "-o", "a.png"}, "--height");
        refused({"normal-map", torus, "-o", "a.png"}, "--height");
        refused({"normal-map", torus, "--height", dots, "-o", "a.png", "--amplitude", "1%", "--extent", "1,1"},
                "--extent");
        refused({"normal-map", torus, torus, "--height", dots, "-o", "a.png", "--amplitude", "1%"}, "torus.obj");

        const auto table = [&](std::vector<std::string> more, const std::string& named) {
            more.insert(more.begin(), {"bump-table", dots});
            refused(more, named);
        };
        refused({"bump-table"}, "grey");
        refused({"bump-table", "", "-o", "a.png"}, "argument 2: is empty");
        table({}, "--out");
        table({"-o", "a.png", "--depth", "half"}, "half");
        table({"-o", "a.png", "--depth", "8"}, "--depth");
        table({"-o", "a.exr", "--depth", "16"}, "a.exr");
        table({"-o", "a.png", "--layout", "bumpslopes"}, "bumpslopes");
        table({"-o", "a.tif", "--depth", "16", "--layout", "bumpslopes"}, "bumpslopes");
        table({"-o", "a.exr", "--units", "metres"}, "--units");
        table({"-o", "a.exr", "--amplitude", "1 %"}, "--amplitude");
        table({"-o", "a.exr", "--no-mips"}, "--no-mips");
        table({"-o", "a.exr", "--wrap-u", "tile"}, "--wrap-u");

        const auto explain = [&](std::vector<std::string> more, const std::string& named) {
            more.insert(more.begin(), {"explain", torus, "--height", dots});
            refused(more, named);
        };
        explain({"--uv", "0.1,0.2", "--extent", "1,1"}, "--extent: is not an option of bake explain");
        explain({"--uv", "0.1,0.2", "--padding", "4"}, "--padding: is not an option of bake explain");
        explain({"--amplitude", "1%"}, "--uv");
        for (const char* uv : {"2,1", "-0.1,0", "nan,0", "0.5", "", "1,1,1"})
            explain({"--amplitude", "1%", "--uv", uv}, "--uv");
    }

    TEST_CASE("usage: bake, bake help and bake help VERB print help, -V the version") {
        const Folder folder;
        const auto out = [&](const std::vector<std::string>& arguments) {
            const Run run = run_bake(folder, arguments);
            CHECK(run.code == 0);
            CHECK(run.err == "");
            return run.out;
        };
        const std::string help = out({"--help"});
        CHECK(out({}) == help);
        CHECK(out({"help"}) == help);
        CHECK(out({"help", "--help"}) == help);
        CHECK(out({"help", "bump-table"}) == out({"bump-table", "--help"}));
        CHECK(out({"-V"}) == out({"--version"}));
        check_refused(folder, {"help", "bumptable"}, 2, "did you mean bump-table?");
    }

    TEST_CASE("usage: unknown verbs and options name the nearest, and are named before what follows from them") {
        const Folder folder;
        const auto meant = [&](const std::vector<std::string>& arguments, const std::string& named) {
            check_refused(folder, arguments, 2, "did you mean " + named + "?");
        };
        meant({"normalmap", dots, "-o", "a.png"}, "normal-map");
        meant({"bump_table"}, "bump-table");
        meant({"normal"}, "normal-map");
        meant({"dispalce"}, "displace");
        meant({"normal-map", dots, "-o", "a.png", "--ampltude", "1%"}, "--amplitude");
        meant({"normal-map", dots, "--ouput", "a.png"}, "--out");
        meant({"normal-map", dots, "--output", "a.png"}, "--out");
        meant({"normal-map", dots, "-o", "a.png", "-amplitude", "1%"}, "--amplitude");
        meant({"bump-table", dots, "-o", "a.exr", "--wrapu", "clamp"}, "--wrap-u");
        meant({"check", dots, "--Strict"}, "--strict");
        const Run far = run_bake(folder, {"check", dots, "--zzzzzz"});
        CHECK(far.code == 2);
        CHECK(far.err.find("did you mean") == std::string::npos);
        fs::copy_file(dots, folder / "dots.png");
        check_refused(folder, {"dots.png"}, 2, "bake check dots.png");
    }

    TEST_CASE("usage: an option is never the value of the option before it") {
        const Folder folder;
        check_refused(folder, {"check", "--pair", dots, "--strict", dots}, 2, "--strict stands where its value");
        check_refused(folder, {"check", dots, "--pair", dots, "--json"}, 2, "--json stands where its value");
        check_refused(folder, {"normal-map", dots, "-o", "--directx"}, 2, "--directx stands where its value");
        // After both values it is an option.
        REQUIRE(run_bake(folder, {"normal-map", dots, "-o", "n.png", "--quiet"}).code == 0);
        const Run pair = run_bake(folder, {"check", "--pair", dots, "n.png", "--json", dots});
        CHECK(pair.code == 0);
        CHECK(nlohmann::json::parse(pair.out)["files"].size() == 2);
    }

    TEST_CASE("usage: a mesh given as a picture, or a picture as a mesh, is told so") {
        const Folder folder;
        const std::string scene = (own_meshes() / "scene.toml").string();
        const std::string for_mesh = "is a mesh, where a picture is expected",
                          for_picture = "is a picture, where a mesh is expected";
        const auto refused = [&](const std::vector<std::string>& arguments, const std::string& named) {
            check_refused(folder, arguments, 3, named);
        };
        refused({"normal-map", "--height", torus, "-o", "a.png"}, for_mesh);
        refused({"normal-map", dots, "--height", dots, "-o", "a.png"}, for_picture);
        refused({"normal-map", dots, "--height", torus, "-o", "a.png"}, for_mesh);
        refused({"displace", dots, "--height", dots, "-o", "a.ply"}, for_picture);
        refused({"displace", torus, "--height", torus, "-o", "a.ply"}, for_mesh);
        refused({"surface", dots, "-o", "a.ply"}, for_picture);
        refused({"bump-table", torus, "-o", "a.exr"}, for_mesh);
        refused({"explain", dots, "--height", dots, "--uv", "0,0"}, for_picture);
        refused({"cubemap", torus, "-o", "a.exr"}, for_mesh);
        check_refused(folder, {"render", dots, "-o", "a.png"}, 2, "is a picture; name the shape to show it on");
        refused({"cubemap", "--capture", dots, "--at", "0,1,0", "-o", "a.exr"}, "where a scene is expected");
        check_refused(folder, {"displace", scene, "--height", dots, "-o", "a.ply"}, 3, "is a scene");
    }

    TEST_CASE("usage: --quiet prints nothing on success, but what check, explain and --json are for") {
        const Folder folder;
        write_file(folder / "scene.toml", "mesh = [{file = \"" + torus + "\"}]\n");
        const std::vector<std::vector<std::string>> writers = {
            {"normal-map", dots, "-o", "n.png"},
            {"normal-map", torus, "--height", dots, "--amplitude", "200%", "--size", "32", "-o", "m.png"},
            {"bump-table", dots, "-o", "t.exr"},
            {"batch", (own_meshes() / "bakes.toml").string(), "--dry-run"},
            {"displace", torus, "--height", dots, "-o", "d.ply"},
            {"surface", torus, "-o", "s.ply"},
            {"surface", "--shape", "sphere", "--maps-out", "m", "--size", "8"},
            {"cubemap", "labels", "--size", "16", "-o", "c.exr"},
            {"compare", dots, dots},
            {"plan", (own_meshes() / "studs.toml").string(), "--size", "8", "--budget", "loose", "-o", "p.toml"},
            {"render", "scene.toml", "-o", "r.png", "--size", "16x16", "--spp", "1"}};
        for (const std::string& verb : verbs()) {
            const bool writes =
                std::any_of(writers.begin(), writers.end(), [&](const auto& w) { return w[0] == verb; });
            CHECK_MESSAGE((writes || verb == "check" || verb == "explain"),
                          "add a command line of " << verb << " here");
        }
        for (std::vector<std::string> arguments : writers) {
            CAPTURE(arguments[0]);
            const Run loud = run_bake(folder, arguments);
            CHECK(loud.code == 0);
            CHECK(loud.out != "");
            arguments.push_back("--quiet");
            const Run quiet = run_bake(folder, arguments);
            CHECK(quiet.code == 0);
            CHECK(quiet.out == "");
            CHECK(quiet.err == "");
            arguments.push_back("--json");
            CHECK(nlohmann::json::parse(run_bake(folder, arguments).out).is_object());
        }
        CHECK(run_bake(folder, {"check", dots, "--quiet"}).out != "");
        CHECK(run_bake(folder, {"explain", torus, "--height", dots, "--uv", "0.5,0.5", "--quiet"}).out != "");
    }

    TEST_CASE("usage: --json prints one object and nothing else, --quiet keeps notes away, endings in capitals work") {
        const Folder folder;
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"bump-table", dots, "-o", "a.EXR", "--json", "--quiet"},
              {"normal-map", "--height", dots, "-o", "A.PNG", "--amplitude", "0.1", "--json"},
              {"normal-map", torus, "--height", dots, "--amplitude", "200%", "-o", "b.TIFF", "--size", "64", "--json",
               "--quiet"}}) {
            const Run run = run_bake(folder, arguments);
            CHECK(run.code == 0);
            CHECK(run.err == "");
            const auto object = nlohmann::json::parse(run.out);
            CHECK(object["error_budget"]["total_deg"].is_number());
            CHECK(object["step_tilt_deg"].get<double>() > 0);
        }
        // Amplitudes beyond the radius of curvature are noted on stderr unless --quiet.
        const Run loud = run_bake(
            folder, {"normal-map", torus, "--height", dots, "--amplitude", "200%", "-o", "b.tif", "--size", "64"});
        CHECK(loud.code == 0);
        CHECK(loud.err.find("turn inside out") != std::string::npos);
    }

} // TEST_SUITE
