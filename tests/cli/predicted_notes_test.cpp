// What the commands predict of a height before it is baked: bake check MESH --height, and the notes of the verbs.
#include "cli/command.h"
#include <nlohmann/json.hpp>

using namespace bake::test;

namespace {

const std::string torus = (own_meshes() / "torus.obj").string(), ripples = (own_meshes() / "ripples.png").string(),
                  bricks = (own_meshes() / "bricks.png").string(), dots = (own_meshes() / "dots.png").string();

Run check(const Folder& folder, std::vector<std::string> more) {
    more.insert(more.begin(), "check");
    return run_bake(folder, more);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("check --height: the mesh's report, and one line for each error with a remedy in flags") {
        const Folder folder;
        const Run run = check(folder, {torus, "--height", ripples, "--amplitude", "4%", "--midlevel", "0.2"});
        CHECK(run.code == 0);
        CHECK(run.err == "");
        CHECK(has(run.out, "torus.obj\n"));
        CHECK(has(run.out, "torus.obj + "));
        CHECK(has(run.out, "blinn is off by up to "));
        CHECK(has(run.out, "; use --method exact\n"));
        CHECK(has(run.out, "; set --midlevel to "));
        const auto files = nlohmann::json::parse(
            check(folder, {torus, "--height", ripples, "--amplitude", "4%", "--json"}).out)["files"];
        REQUIRE(files.size() == 2);
        CHECK(files[0]["kind"] == "mesh");
        CHECK(files[1]["kind"] == "relief");
        CHECK(files[1]["blinn"]["largest_deg"].get<double>() > 0.318);
        CHECK(files[1]["fold"]["share"] == 0);
    }

    TEST_CASE("check --height: a fold is a warning, and the amplitude that it names is free of it") {
        const Folder folder;
        const std::vector<std::string> line = {torus, "--height", ripples, "--strict", "--amplitude"};
        const auto with = [&](const std::string& amplitude) {
            std::vector<std::string> all = line;
            all.push_back(amplitude);
            return check(folder, all);
        };
        const Run run = with("1.4");
        CHECK(run.code == 1);
        const auto at = run.out.find("reduce --amplitude to ");
        REQUIRE(at != std::string::npos);
        const std::string safe = run.out.substr(at + 22, run.out.find(',', at) - at - 22);
        CHECK_MESSAGE(with(safe).code == 0, safe);
        const Run displaced =
            run_bake(folder, {"displace", torus, "--height", ripples, "--amplitude", safe, "-o", "a.ply"});
        CHECK(has(displaced.out, "; 0 points folded"));
    }

    TEST_CASE("check --height: says nothing of a gentle height, and what it needs") {
        const Folder folder;
        const Run quiet = check(folder, {torus, "--height", ripples, "--amplitude", "0.001%", "--filter", "c2"});
        CHECK_FALSE(has(quiet.out, "; use --"));
        CHECK(has(quiet.out, "nothing wrong"));
        // Without an amplitude it is told which one is taken.
        CHECK(has(check(folder, {torus, "--height", ripples}).err, "1 % of the bounding box's diagonal"));
        check_refused(folder, {"check", "--height", ripples}, 2, "--height: needs a mesh");
        check_refused(folder, {"check", bricks, "--height", ripples}, 2, "is no mesh, which --height needs");
        check_refused(folder, {"check", torus, "--height", torus}, 3, "where a picture is expected");
        check_refused(folder, {"check", torus, "--amplitude", "1"}, 2, "--height");
        check_refused(folder, {"check", torus, "--height", ripples, "--against", torus}, 2, "--against");
        CHECK(has(check(folder, {torus, "--height", ripples, "--amplitude", "1e12"}).err, "--amplitude 1e12: is more"));
        write_file(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        CHECK(check(folder, {"bare.obj", "--height", ripples}).code == 4);
    }

    TEST_CASE("displace: a note tells what the faces miss, and none does where they are fine enough") {
        const Folder folder;
        const auto displace = [&](const std::string& levels, const std::string& form) {
            return run_bake(folder, {"displace", torus, "--height", bricks, "--amplitude", "2%", "--levels", levels,
                                     "--measure", form, "-o", "a.ply"});
        };
        const std::string said_of_coarse = displace("0", "--margin").err;
        CHECK(has(said_of_coarse, "the faces miss 39 % of the relief"));
        CHECK(has(said_of_coarse, "raise --levels, or put the rest into a map by bake normal-map --residual-of"));
        const auto said = nlohmann::json::parse(displace("0", "--json").out);
        const double ratio = said["faces_miss"]["rms"].get<double>() / said["measured_error"]["rms"].get<double>();
        CHECK(ratio > 0.5);
        CHECK(ratio < 2);
        CHECK_FALSE(has(displace("2", "--margin").err, "the faces miss "));
    }

    TEST_CASE("bump-table: notes tell levels that show and slopes that the filter loses, at a stated amplitude") {
        const Folder folder;
        const auto table = [&](std::vector<std::string> more) {
            more.insert(more.begin(), {"bump-table", dots, "-o", "a.exr"});
            return run_bake(folder, more).err;
        };
        CHECK(has(table({"--amplitude", "0.2", "--filter", "c2"}), "its levels tilt the normal by "));
        CHECK_FALSE(has(table({"--amplitude", "0.0005"}), "its levels tilt"));
        CHECK_FALSE(has(table({"--amplitude", "0.0005"}), "of the slopes"));
    }

    TEST_CASE("render: a note tells how high the relief should stand at the outline, unless it is displaced") {
        const Folder folder;
        const auto told = [&](const std::string& shade, const std::string& amplitude) {
            write_file(folder / "s.toml",
                       "[[camera]]\nposition = [0, 3, 4]\ntarget = [0, 0, 0]\n[[material]]\nname = \"relief\"\n"
                       "height = {file = \"" +
                           ripples + "\", amplitude = \"" + amplitude + "\"}\nshade = \"" + shade +
                           "\"\n[[mesh]]\nfile = \"" + torus + "\"\nmaterial = \"relief\"\n");
            const Run run = run_bake(folder, {"render", "s.toml", "-o", "a.png", "--size", "64"});
            CHECK_MESSAGE(run.code == 0, run.err);
            return has(run.err, "material \"relief\": the relief is shown by normals alone");
        };
        CHECK(told("exact", "6%"));
        CHECK(told("bump", "6%"));
        CHECK_FALSE(told("displace:2", "6%"));
        CHECK_FALSE(told("plain", "6%"));
        CHECK_FALSE(told("exact", "0.1%"));
    }
}
