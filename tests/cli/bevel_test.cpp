// bake normal-map --bevel from outside.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

using Strings = std::vector<std::string>;

/// Two unit squares that meet in the line x = 1 at 90 degrees, with charts side by side. `fold`: -1 convex, 1 concave.
std::string fold(int up) {
    const std::string z = std::to_string(up);
    return "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 " + z + "\nv 1 1 " + z +
           "\nvt .02 .02\nvt .48 .02\nvt .48 .98\nvt .02 .98\nvt .52 .02\nvt .98 .02\nvt .98 .98\nvt .52 .98\n"
           "f 1/1 2/2 3/3 4/4\nf 2/5 5/6 6/7 3/8\n";
}

struct Meshes : Folder {
    Meshes() {
        write_file(*this / "fold.obj", fold(-1));
        write_file(*this / "groove.obj", fold(1));
    }
};

Strings command(const Strings& more, const std::string& mesh = "fold.obj") {
    Strings all = {"normal-map", mesh, "-o", "n.png", "--size", "100x50"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

nlohmann::json said(const Folder& folder, Strings arguments) {
    arguments.insert(arguments.end(), {"--json", "--quiet"});
    const Run run = run_bake(folder, arguments);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    return nlohmann::json::parse(run.out);
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("bevel: the tilt at a distance d from an edge of 90 degrees is atan((R - d) / R), of a groove inward") {
        const Meshes folder;
        for (const bool concave : {false, true}) {
            const auto object =
                said(folder, command({"--bevel", "0.4", "--space", "object"}, concave ? "groove.obj" : "fold.obj"));
            CHECK(object["edges"]["convex"] == (concave ? 0 : 1));
            CHECK(object["edges"]["concave"] == (concave ? 1 : 0));
            CHECK(object["bevel"]["radius"] == 0.4);
            CHECK(object["bevel"]["texels"].get<double>() == doctest::Approx(0.4 * std::sqrt(46 * 48)).epsilon(0.01));
            CHECK(object["texels"]["narrow"] == 0);
            const Image<float> map = read_image(folder / "n.png");
            for (int x = 4; x < 47; ++x) {
                const double d = 1 - ((x + 0.5) / 100 - 0.02) / 0.46;
                const double tilt = std::max(0.0, std::atan((0.4 - d) / 0.4)) * (concave ? -1 : 1);
                CHECK(double(map.at(x, 25, 0)) == doctest::Approx(0.5 + 0.5 * std::sin(tilt)).epsilon(1e-4));
                CHECK(double(map.at(x, 25, 1)) == doctest::Approx(0.5).epsilon(1e-4));
            }
        }
    }

    TEST_CASE("bevel: lengths are object units or per cent of the diagonal; the size is 1024 unless given") {
        const Meshes folder;
        // The diagonal of both squares is sqrt 3.
        CHECK(said(folder, command({"--bevel", "10%"}))["bevel"]["radius"].get<double>() ==
              doctest::Approx(0.1 * std::sqrt(3)));
        const auto object = said(folder, {"normal-map", "fold.obj", "--bevel", "0.1", "-o", "n.png"});
        CHECK(object["width"] == 1024);
        CHECK(object["height"] == 1024);
    }

    TEST_CASE("bevel: what does not go with it is a usage error") {
        const Meshes folder;
        const std::string dots = (own_meshes() / "dots.png").string();
        check_refused(folder, command({"--bevel", "1", "--height", dots}), 2,
                      "--bevel, --height: the detail comes from");
        check_refused(folder, command({"--bevel", "1", "--high", "fold.obj"}), 2, "--bevel, --high: the detail comes");
        check_refused(folder, {"normal-map", "--bevel", "1", "-o", "n.png"}, 2, "--bevel: needs a mesh");
        check_refused(folder, command({"--bevel", "1"}, dots), 3, "is a picture, where a mesh is expected");
        for (const char* option : {"--amplitude=1", "--method=blinn", "--wrap=clamp", "--invert", "--extent=1,1"})
            check_refused(folder, command({"--bevel", "1", option}), 2, "leave it out with --bevel");
        for (const char* radius : {"0", "-1", "0%", "1x", "1e13"})
            check_refused(folder, command({"--bevel", radius}), 2, "--bevel");
        check_refused(folder, {"normal-map", "fold.obj", "--bevel", "1", "-o", "none/n.png"}, 5, "cannot be written");
        write_file(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
        check_refused(folder, command({"--bevel", "1"}, "bare.obj"), 4, "bare.obj: has no uvs; unwrap the mesh first");
    }

    TEST_CASE(
        "bevel: notes say that nothing is hard, that the bevel is too few texels, and that the ball does not fit") {
        const Meshes folder;
        const auto noted = [&](const Strings& arguments, const std::string& words) {
            const Run run = run_bake(folder, arguments);
            CAPTURE(run.err);
            CHECK(run.code == 0);
            CHECK(lines(run.err) == 1);
            CHECK(run.err.find(words) != std::string::npos);
        };
        noted(command({"--bevel", "1%"}, (own_meshes() / "torus.obj").string()), "torus.obj: has no hard edges");
        noted(command({"--bevel", "0.02"}), "fold.obj: a radius of 0.94 texels is too few for a bevel");
        // A step of height .2, whose middle a ball of radius .3 does not reach.
        write_file(folder / "ledge.obj",
                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -.2\nv 1 1 -.2\nv 0 0 -.2\nv 0 1 -.2\n"
                   "vt 0 0\nvt .3 0\nvt .3 .9\nvt 0 .9\nvt .4 0\nvt .5 0\nvt .5 .9\nvt .4 .9\n"
                   "vt .6 0\nvt .9 0\nvt .9 .9\nvt .6 .9\n"
                   "f 1/1 2/2 3/3 4/4\nf 2/5 5/6 6/7 3/8\nf 5/9 7/10 8/11 6/12\n");
        noted(command({"--bevel", "0.3"}, "ledge.obj"), "texels lie where the radius does not fit");
    }

    TEST_CASE("bevel: 1, 2 and 7 threads write the same bytes, and <UDIM> one map for each tile") {
        const Meshes folder;
        std::vector<std::string> maps;
        for (const char* threads : {"1", "2", "7"}) {
            said(folder, command({"--bevel", "0.3", "--threads", threads}));
            maps.push_back(contents(folder / "n.png"));
        }
        CHECK((maps[0] == maps[1]));
        CHECK((maps[0] == maps[2]));
        write_file(folder / "tiles.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\n"
                                         "vt 0 0\nvt .9 0\nvt .9 .9\nvt 0 .9\nvt 1 0\nvt 1.9 0\nvt 1.9 .9\nvt 1 .9\n"
                                         "f 1/1 2/2 3/3 4/4\nf 2/5 5/6 6/7 3/8\n");
        const auto object =
            said(folder, {"normal-map", "tiles.obj", "--bevel", "0.3", "-o", "t_<UDIM>.png", "--size", "16"});
        CHECK(object["tiles"].size() == 2);
        CHECK(object["tiles"][1]["tile"] == 1002);
        CHECK(fs::exists(folder / "t_1001.png"));
        CHECK(fs::exists(folder / "t_1002.png"));
        const auto one = said(folder, command({"--bevel", "0.3", "--tile", "1001"}, "tiles.obj"));
        CHECK(one["texels"]["hit"].get<int>() > 0);
    }

    TEST_CASE("bevel: textures and object space") {
        const Meshes folder;
        CHECK(said(folder, {"normal-map", "fold.obj", "--bevel", "0.3", "-o", "n.dds", "--size", "32"})
                  .contains("stored"));
        said(folder, command({"--bevel", "0.3", "--space", "object"}));
        const Image<float> map = read_image(folder / "n.png");
        CHECK(double(map.at(90, 25, 0)) == doctest::Approx(1).epsilon(1e-3)); // the side that faces +x
        CHECK(double(map.at(10, 25, 2)) == doctest::Approx(1).epsilon(1e-3));
        check_refused(folder, command({"--bevel", "1", "--space", "object", "--directx"}), 2, "--directx");
    }

} // TEST_SUITE
