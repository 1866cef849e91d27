// What the commands tell of a method that is less accurate than exact.
#include "cli/command.h"
#include <nlohmann/json.hpp>

using namespace bake::test;

namespace {

const std::string torus = (own_meshes() / "torus.obj").string(), ripples = (own_meshes() / "ripples.png").string();

Run normal_map(const Folder& folder, std::vector<std::string> more, const std::string& amplitude = "4%") {
    std::vector<std::string> line = {"normal-map", torus,    "--height", ripples,       "-o",
                                     "n.png",      "--size", "128",      "--amplitude", amplitude};
    line.insert(line.end(), more.begin(), more.end());
    return run_bake(folder, line);
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("normal-map: a note tells how far a method is off, and what to use; exact has none") {
        const Folder folder;
        for (const std::string method : {"blinn", "surface-gradient", "constant-scale"}) {
            CAPTURE(method);
            const Run run = normal_map(folder, {"--method", method});
            CHECK(run.code == 0);
            CHECK(run.err.find(method + " is off by up to ") != std::string::npos);
            CHECK(run.err.find("; use --method exact\n") != std::string::npos);
            const auto said = nlohmann::json::parse(normal_map(folder, {"--method", method, "--json"}).out);
            CHECK(said["method_error"]["largest_deg"].get<double>() > 0.318);
        }
        CHECK(normal_map(folder, {}).err.find("is off by") == std::string::npos);
        CHECK(normal_map(folder, {"--method", "blinn"}, "0.001%").err.find("is off by") == std::string::npos);
    }

    TEST_CASE("render: a note tells how far the shade of a material is off") {
        const Folder folder;
        const auto told = [&](const std::string& shade) {
            write_file(folder / "s.toml",
                       "[[camera]]\nposition = [0, 3, 4]\ntarget = [0, 0, 0]\n[[material]]\nname = \"relief\"\n"
                       "height = {file = \"" +
                           ripples + "\", amplitude = \"4%\"}\nshade = \"" + shade + "\"\n[[mesh]]\nfile = \"" + torus +
                           "\"\nmaterial = \"relief\"\n");
            const Run run = run_bake(folder, {"render", "s.toml", "-o", "a.png", "--size", "16"});
            CHECK_MESSAGE(run.code == 0, run.err);
            return run.err;
        };
        for (const std::string shade : {"blinn", "bump", "constant-scale"})
            CHECK(told(shade).find("; use shade = \"exact\"") != std::string::npos);
        CHECK(told("exact").find("is off by") == std::string::npos);
    }
}
