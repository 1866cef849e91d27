// bake compare: pictures, normal maps and meshes, from outside.
#include "bake/picture/image_io.h"
#include "bake/verdict/metric/false_colour.h"
#include "cli/command.h"
#include "verdict/metric/pictures.h"
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

const std::string torus = (own_meshes() / "torus.obj").string(), sphere = (own_meshes() / "sphere.obj").string(),
                  bricks = (own_meshes() / "bricks.png").string();

/// a.exr, b.exr: noise; a.png, b.png: the same in 8 bits.
void write_pictures(const Folder& folder) {
    for (const unsigned seed : {1u, 2u}) {
        const std::string name = folder / (seed == 1 ? "a" : "b");
        write_image(name + ".exr", noisy(40, 30, seed), {.depth = Depth::float32});
        write_image(name + ".png", noisy(40, 30, seed), {.depth = Depth::u8});
    }
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("compare: a table of all metrics, and the same numbers as JSON") {
        const Folder folder;
        write_pictures(folder);
        const Run text = run_bake(folder, {"compare", "a.exr", "b.exr"});
        CHECK(text.code == 0);
        for (const char* part : {"a.exr against b.exr", "40 x 30, colour", "at exposure ", "automatic", "\n  rmse ",
                                 "\n  psnr ", "\n  ssim ", "\n  flip ", "\n  hdr-flip "})
            CHECK_MESSAGE(has(text.out, part), std::string(part));
        const auto json = nlohmann::json::parse(run_bake(folder, {"compare", "a.exr", "b.exr", "--json"}).out);
        CHECK(json["kind"] == "pictures");
        CHECK(json["metrics"].size() == 5);
        const double mean = json["metrics"]["flip"]["errors"]["mean"];
        CHECK(json["metrics"]["flip"]["value"] == mean);
        CHECK(mean > 0);
        char printed[32];
        std::snprintf(printed, sizeof printed, "%.6g", mean);
        CHECK(has(text.out, printed));
        CHECK(json["hdr_exposures"]["count"].get<int>() >= 2);
        const Run one = run_bake(folder, {"compare", "a.png", "b.png", "--metric", "psnr"});
        CHECK(one.code == 0);
        CHECK_FALSE(has(one.out, "flip "));
        CHECK(run_bake(folder, {"compare", "a.png", "b.png", "--quiet"}).out == "");
    }

    TEST_CASE("compare --limit: exit 1 beyond, the picture and the report there all the same") {
        const Folder folder;
        write_pictures(folder);
        const Run over = run_bake(folder, {"compare", "a.png", "b.png", "--limit", "flip=0.001", "-o", "diff.png"});
        CHECK(over.code == 1);
        CHECK(has(over.out, "warning: over the limit: flip is "));
        CHECK(fs::exists(folder / "diff.png"));
        const auto code = [&](const std::vector<std::string>& limits) {
            std::vector<std::string> line = {"compare", "a.png", "b.png"};
            for (const std::string& limit : limits) line.insert(line.end(), {"--limit", limit});
            return run_bake(folder, line).code;
        };
        CHECK(code({"flip=1", "rmse=10", "psnr=1", "flip-max=1"}) == 0);
        CHECK(code({"flip=1", "psnr=99"}) == 1);
        CHECK(run_bake(folder, {"compare", "a.png", "a.png", "--limit", "psnr=1000", "--limit", "ssim=1"}).code == 0);
    }

    TEST_CASE("compare -o: the errors in false colour as .png, as floats otherwise") {
        const Folder folder;
        write_pictures(folder);
        CHECK(run_bake(folder, {"compare", "a.exr", "b.exr", "--metric", "flip", "-o", "d.png"}).code == 0);
        CHECK(run_bake(folder, {"compare", "a.exr", "b.exr", "--metric", "flip", "-o", "d.exr"}).code == 0);
        const Image<float> png = read_image(folder / "d.png"), exr = read_image(folder / "d.exr");
        REQUIRE(png.channels() == 3);
        REQUIRE(exr.channels() == 1);
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x)
                for (int c = 0; c < 3; ++c) REQUIRE(std::abs(png.at(x, y, c) - magma(exr.at(x, y))[c]) <= 0.51f / 255);
    }

    TEST_CASE("compare --normals: green that points the other way is found, and angles are those of 8 bits") {
        const Folder folder;
        for (const char* convention : {"opengl", "directx"}) {
            std::vector<std::string> line = {"normal-map", bricks, "-o", std::string(convention) + ".png"};
            if (convention == std::string("directx")) line.push_back("--directx");
            REQUIRE(run_bake(folder, line).code == 0);
        }
        const Run run = run_bake(folder, {"compare", "--normals", "opengl.png", "directx.png", "--limit",
                                          "angle-max=0.4", "-o", "angles.exr", "--json"});
        CHECK(run.code == 0);
        const auto json = nlohmann::json::parse(run.out);
        CHECK(json["green"] == "opposed");
        CHECK(json["angle_deg"]["max"].get<double>() < 0.4);
        CHECK(read_image(folder / "angles.exr").channels() == 1);
        const Run object = run_bake(folder, {"compare", "--normals", "opengl.png", "directx.png", "--space", "object",
                                             "--limit", "angle-max=1"});
        CHECK(object.code == 1); // where green is not examined
    }

    TEST_CASE("compare of meshes: the report of check --against, and its limit") {
        const Folder folder;
        const auto without_seconds = [](const std::string& text) { return text.substr(0, text.find("nothing wrong")); };
        const Run check = run_bake(folder, {"check", torus, "--against", sphere}),
                  compare = run_bake(folder, {"compare", torus, sphere});
        CHECK(compare.code == 0);
        CHECK(without_seconds(compare.out) == without_seconds(check.out));
        CHECK(run_bake(folder, {"compare", torus, sphere, "--limit", "distance=0.001"}).code == 1);
        CHECK(run_bake(folder, {"compare", torus, torus, "--limit", "distance=0.001"}).code == 0);
    }

    TEST_CASE("compare: refusals are one line that names the file or the option, and leave nothing behind") {
        const Folder folder;
        write_pictures(folder);
        write_image(folder / "small.png", noisy(20, 30, 1), {.depth = Depth::u8});
        Image<float> bad = noisy(40, 30, 3);
        bad.at(12, 7, 0) = std::numeric_limits<float>::quiet_NaN();
        write_image(folder / "bad.exr", bad, {.depth = Depth::float32});
        write_file(folder / "scene.toml", "mesh = []\n");
        const auto refused = [&](int code, std::vector<std::string> arguments, const std::string& named) {
            arguments.insert(arguments.begin(), "compare");
            check_refused(folder, arguments, code, named);
        };
        refused(4, {"a.png", "small.png"}, "small.png: is 20 x 30, where a.png is 40 x 30");
        refused(4, {"a.exr", "bad.exr", "-o", "d.png"},
                "bad.exr: 1 pixel is NaN or Inf, the first at column 12, row 7");
        refused(3, {"a.exr", "absent.exr"}, "absent.exr");
        refused(3, {"a.exr", torus}, "is a picture, where a mesh is expected");
        refused(2, {"scene.toml", "a.exr"}, "a.exr: the methods of one scene are compared; leave the second file out");
        refused(2, {"a.png"}, "a.png: what is it compared with?");
        refused(2, {"a.png", "b.png", "--limit", "flip"}, "--limit flip: is not METRIC=VALUE");
        refused(2, {"a.png", "b.png", "--limit", "flip=x"}, "--limit flip");
        refused(2, {"a.png", "b.png", "--limit", "angle=1"}, "--limit angle: is not computed here");
        refused(2, {"a.png", "b.png", "--metric", "psnr", "--limit", "flip=1"}, "these are: psnr");
        refused(2, {"a.png", "b.png", "--ppd", "0"}, "--ppd");
        refused(2, {"a.png", "b.png", "--space", "object"}, "--space");
        refused(2, {"a.png", "b.png", "-o", "d.jpg"}, "d.jpg");
        refused(2, {"a.png", "b.png", "-o", "b.png"}, "b.png");
        refused(2, {"a.png", "b.png", "--normals", "--exposure", "1"}, "--exposure");
        refused(2, {"a.png", "b.png", "--samples", "10"}, "--samples");
        refused(2, {torus, sphere, "--metric", "flip"}, "--metric");
        refused(2, {torus, sphere, "-o", "d.png"}, "--out");
        refused(2, {torus, sphere, "--limit", "flip=1"}, "--limit flip: is not computed of meshes");
    }
}
