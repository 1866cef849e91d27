// bake render without a scene file, and the options that change a scene's view.
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "preview/little_scenes.h"
#include <cmath>
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

const std::string dots = own_meshes() / "dots.png";
const std::string dots_normal = own_meshes() / "dots_normal.png";
const std::string torus = own_meshes() / "torus.obj";

Image<float> render(const Folder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    for (const char* more : {"-o", "a.exr", "--depth", "float"}) arguments.push_back(more);
    const Run run = run_bake(folder, arguments);
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return read_image(folder / "a.exr");
}

double difference(const Image<float>& a, const Image<float>& b) {
    REQUIRE(a.size() == b.size());
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(double(a.data()[i]) - b.data()[i]);
    return sum / double(a.size());
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("render: a mesh without a scene has a frame, three lights, and the material that is asked for") {
        const Folder folder;
        const std::vector<std::string> small = {torus, "--size", "48", "--spp", "1"};
        const Image<float> plain = render(folder, small);
        std::vector<std::string> red = small;
        red.insert(red.end(), {"--material", "diffuse=#ff0000,specular=0"});
        const Image<float> coloured = render(folder, red);
        const Vec3f background(plain.at(0, 0, 0), plain.at(0, 0, 1), plain.at(0, 0, 2));
        int seen = 0;
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) {
                if (plain.at(x, y, 0) == background.x && plain.at(x, y, 1) == background.y) continue;
                ++seen;
                CHECK(plain.at(x, y, 1) > 0);
                CHECK(coloured.at(x, y, 1) == 0);
            }
        CHECK(seen > 300);
        CHECK(seen < 48 * 48 - 300);
    }

    TEST_CASE("render: a normal map, a bump table and a height on a shape; the flat shape looks different from each") {
        const Folder folder;
        REQUIRE(run_bake(folder, {"bump-table", dots, "-o", "t.exr", "--amplitude", "0.05"}).code == 0);
        const std::vector<std::string> view = {"--size", "48", "--spp", "1"};
        const auto on = [&](std::vector<std::string> arguments) {
            arguments.insert(arguments.end(), view.begin(), view.end());
            return render(folder, arguments);
        };
        const Image<float> flat = on({dots, "--on", "sphere", "--material", "bump-scale=0"});
        const Image<float> height = on({dots, "--on", "sphere"});
        CHECK(difference(on({dots_normal, "--on", "sphere"}), flat) > 0.01);
        CHECK(difference(on({"t.exr", "--on", "sphere"}), flat) > 0.01);
        CHECK(difference(height, flat) > 0.01);
        CHECK(difference(on({dots, "--on", "sphere", "--as", "height"}), height) == 0);
        CHECK(difference(on({dots, "--on", "torus:R=1,r=0.6"}), on({dots, "--on", "cube"})) > 0.01);
    }

    TEST_CASE("render: what a picture is taken for, and a height's amplitude, are told") {
        const Folder folder;
        const Run run = run_bake(folder, {"render", dots, "--on", "cube", "-o", "a.png", "--size", "8"});
        CHECK(run.code == 0);
        CHECK(run.err.find("is taken for a height; --as") != std::string::npos);
        CHECK(run.err.find("the amplitude is ") != std::string::npos);
        const Run json = run_bake(folder, {"render", dots, "--on", "cube", "-o", "a.png", "--size", "8", "--json"});
        CHECK(nlohmann::json::parse(json.out)["notes"].size() == 3); // and the exposure
    }

    TEST_CASE("render: --sky shows the sky, of a mesh and instead of a scene's") {
        const Folder folder;
        const Image<float> labels = render(folder, {torus, "--size", "32", "--spp", "1", "--sky", "labels"});
        const std::string faces = (own_meshes() / "sky_%s.png").string();
        const Image<float> sky = render(folder, {torus, "--size", "32", "--spp", "1", "--sky", faces});
        CHECK(difference(labels, sky) > 0.05);
        write_file(folder / "s.toml",
                   "sky = {faces = \"" + faces + "\"}\ncamera = {position = [0, 0, 0], target = [0, 0, 1]}\n");
        const Image<float> own = render(folder, {"s.toml", "--size", "32", "--spp", "1"});
        const Image<float> other = render(folder, {"s.toml", "--size", "32", "--spp", "1", "--sky", "labels"});
        CHECK(difference(own, other) > 0.05);
        CHECK(difference(own, render(folder, {"s.toml", "--size", "32", "--spp", "1", "--sky", faces})) == 0);
        check_refused(folder, {"render", torus, "-o", "b.png", "--sky", "gone_%s.png"}, 3, "gone_px.png");
    }

    TEST_CASE("render: --crop is that part of the whole picture") {
        const Folder folder;
        const std::string scene = own_meshes() / "gallery.toml";
        for (const char* camera : {"hall", "plan"}) {
            const Image<float> whole = render(folder, {scene, "--camera", camera, "--size", "96x48", "--spp", "1"});
            const Image<float> part =
                render(folder, {scene, "--camera", camera, "--size", "96x48", "--spp", "1", "--crop", "20,9,40,31"});
            REQUIRE(part.width() == 40);
            REQUIRE(part.height() == 31);
            int off = 0;
            for (int y = 0; y < 31; ++y)
                for (int x = 0; x < 40; ++x) off += part.at(x, y, 1) != whole.at(x + 20, y + 9, 1);
            CHECK(off == 0);
        }
        check_refused(folder, {"render", scene, "-o", "b.png", "--size", "96x48", "--crop", "60,0,40,10"}, 2, "--crop");
        for (const char* crop : {"1,2,3", "1,2,3,4,5", "0,0,0,4", "-1,0,4,4", "a,0,4,4", "0,0,4,4,", "", "1.5,0,4,4"})
            check_refused(folder, {"render", scene, "-o", "b.png", "--crop", crop}, 2, "--crop");
    }

    TEST_CASE("render: --camera takes a camera of the scene by its name, or tells the nearest one") {
        const Folder folder;
        const std::string scene = own_meshes() / "gallery.toml";
        const Image<float> first = render(folder, {scene, "--size", "32x16", "--spp", "1"});
        CHECK(difference(first, render(folder, {scene, "--size", "32x16", "--spp", "1", "--camera", "hall"})) == 0);
        CHECK(difference(first, render(folder, {scene, "--size", "32x16", "--spp", "1", "--camera", "plan"})) > 0.01);
        check_refused(folder, {"render", scene, "-o", "b.png", "--camera", "hal"}, 2, "did you mean \"hall\"?");
    }

    TEST_CASE("render: --camera takes a camera of a glTF file") {
        const Folder folder;
        write_mesh(folder / "ball.gltf", sphere_mesh(16, 8));
        std::string text = contents(folder / "ball.gltf");
        // A node beside that of the mesh, whose camera sees the ball from +Z, 4 high.
        nlohmann::json file = nlohmann::json::parse(text);
        file["cameras"] = nlohmann::json::parse(R"([{"type": "orthographic",
            "orthographic": {"xmag": 2, "ymag": 2, "znear": 0, "zfar": 9}}])");
        file["nodes"].push_back(nlohmann::json::parse(R"({"name": "front", "camera": 0, "translation": [0, 0, 5]})"));
        write_file(folder / "ball.gltf", file.dump());
        const Image<float> seen = render(folder, {"ball.gltf", "--camera", "front", "--size", "64", "--spp", "1"});
        const float background = seen.at(0, 0, 0);
        int inside = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) inside += seen.at(x, y, 0) != background;
        // A 16-gon of radius 16 pixels, seen from the side: between the octagon's and the circle's area.
        CHECK(inside > 0.9 * pi * 256);
        CHECK(inside < 1.02 * pi * 256);
        check_refused(folder, {"render", "ball.gltf", "--camera", "fron", "-o", "b.png"}, 2, "did you mean \"front\"?");
    }

    TEST_CASE("render: options that contradict each other or the input are usage errors that name them") {
        const Folder folder;
        write_file(folder / "s.toml", "mesh = [{shape = \"cube\"}]\n");
        const auto refused = [&](std::vector<std::string> arguments, const std::string& named) {
            arguments.insert(arguments.begin(), "render");
            arguments.insert(arguments.end(), {"-o", "b.png"});
            check_refused(folder, arguments, 2, named);
        };
        refused({dots}, "--on: ");
        refused({torus, "--on", "cube"}, "--on: ");
        refused({"s.toml", "--on", "cube"}, "--on: ");
        refused({torus, "--as", "normal"}, "--as: ");
        refused({"s.toml", "--as", "bump"}, "--as: ");
        refused({"s.toml", "--material", "diffuse=1"}, "--material: ");
        refused({dots, "--on", "cube", "--camera", "a"}, "--camera: ");
        refused({torus, "--camera", "a"}, "--camera a: ");
        refused({dots, "--on", "ball"}, "shape \"ball\" does not exist; give one of cube, plane");
        refused({dots, "--on", "cube", "--as", "displacement"}, "--as");
        refused({torus, "--material", "difuse=1"}, "did you mean \"diffuse\"?");
        refused({dots_normal, "--on", "cube", "--material", "normal=n.png"}, "--material normal=n.png: ");
    }

    TEST_CASE("render: a map on a mesh that the same height displaced is warned of, the residual map is not") {
        const Folder folder;
        const auto run = [&](const std::vector<std::string>& arguments) {
            const Run done = run_bake(folder, arguments);
            REQUIRE_MESSAGE(done.code == 0, done.err);
            return done.err;
        };
        run({"displace", torus, "--height", dots, "--amplitude", "1%", "--levels", "2", "-o", "d.glb"});
        run({"normal-map", torus, "--height", dots, "--amplitude", "1%", "-o", "whole.png"});
        run({"normal-map", torus, "--height", dots, "--amplitude", "1%", "--residual-of", "d.glb", "-o", "rest.png"});
        const auto shown = [&](const std::string& mesh, const std::string& map) {
            return run({"render", mesh, "-o", "a.png", "--size", "32", "--spp", "1", "--material", "normal=" + map});
        };
        CHECK(shown("d.glb", "whole.png").find("slopes count twice") != std::string::npos);
        CHECK(shown("d.glb", "rest.png").find("slopes count twice") == std::string::npos);
        CHECK(shown(torus, "whole.png").find("slopes count twice") == std::string::npos);
        for (const std::vector<std::string>& wrong :
             {std::vector<std::string>{"normal-map", dots, "--residual-of", "d.glb", "-o", "x.png"},
              {"normal-map", torus, "--height", dots, "--residual-of", "d.glb", "--space", "object", "-o", "x.png"}})
            CHECK(run_bake(folder, wrong).code == 2);
    }

    TEST_CASE("render: shade without a height is refused in the words of the command line") {
        const Folder folder;
        const Run run = run_bake(folder, {"render", torus, "-o", "a.png", "--material", "shade=exact"});
        CHECK(run.code == 2);
        CHECK(run.err.find("--material shade=exact: shade=exact shows a height, and there is none; add height=FILE") !=
              std::string::npos);
    }

    TEST_CASE("render: --texture-filter changes what is far, and not what is near") {
        const Folder folder;
        const std::vector<std::string> small = {own_meshes() / "floor.toml", "--size", "40"};
        const auto filtered = [&](const std::string& filter) {
            std::vector<std::string> arguments = small;
            arguments.insert(arguments.end(), {"--texture-filter", filter});
            return render(folder, arguments);
        };
        const Image<float> off = filtered("off"), mips = filtered("mips"), moments = filtered("moments");
        CHECK(difference(render(folder, small), moments) == 0);
        CHECK(difference(off, moments) > 1e-3);
        CHECK(difference(mips, moments) > 1e-3);
    }

} // TEST_SUITE
