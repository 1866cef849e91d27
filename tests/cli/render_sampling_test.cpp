// bake render: samples by noise and by time, pictures on the way, viewers, one pixel.
#include "bake/picture/image_io.h"
#include "bake/preview/tone.h"
#include "cli/command.h"
#include "preview/loopback_viewer.h"
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

const std::string scene = own_meshes().string() + "/scene.toml", gallery = own_meshes().string() + "/gallery.toml",
                  torus = own_meshes().string() + "/torus.obj";

std::vector<std::string> render(const std::string& input, const std::vector<std::string>& more) {
    std::vector<std::string> all = {"render", input};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

nlohmann::json json_of(const Run& run) {
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return nlohmann::json::parse(run.out);
}

/// Values of the entry of this name.
std::vector<double> values(const nlohmann::json& route, const std::string& name) {
    for (const auto& step : route["route"])
        for (const auto& entry : step["entries"])
            if (entry["name"] == name) return entry["values"];
    return {};
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("render --noise: samples where noise is, the same bytes for any number of threads") {
        const Folder folder;
        std::string first;
        for (const char* threads : {"1", "3"}) {
            const nlohmann::json result =
                json_of(run_bake(folder, render(scene, {"-o", "a.exr", "--size", "64x48", "--noise", "0.05", "--spp",
                                                        "256", "--threads", threads, "--json"})));
            CHECK(result["spp"] == 256);
            CHECK(result["samples"]["least"] >= 16);
            CHECK(result["samples"]["least"] < result["samples"]["most"]);
            CHECK(result["samples"]["mean"] >= result["samples"]["least"]);
            CHECK(result["interrupted"] == false);
            if (first.empty()) first = contents(folder / "a.exr");
            CHECK((contents(folder / "a.exr") == first));
        }
        const Run run =
            run_bake(folder, render(scene, {"-o", "a.exr", "--size", "64x48", "--noise", "0.05", "--spp", "256"}));
        CHECK(run.out.find(" spp (") != std::string::npos);
    }

    TEST_CASE("render --time-limit: ends in time and says what it reached") {
        const Folder folder;
        const Run run =
            run_bake(folder, render(torus, {"-o", "a.png", "--size", "64", "--time-limit", "0.3", "--json"}));
        const nlohmann::json result = json_of(run);
        CHECK(result["samples"]["least"] >= 1);
        CHECK(result["samples"]["mean"] > 1);
        CHECK(result["seconds"]["render"] < 5);
        CHECK(json_of(run_bake(folder, render(torus, {"-o", "a.png", "--size", "16", "--time-limit", "60", "--spp", "2",
                                                      "--json"})))["samples"]["most"] == 2);
    }

    TEST_CASE("render: Ctrl-C writes what is rendered and says so; twice, it leaves nothing") {
        const Folder folder;
        const std::vector<std::string> endless = render(torus, {"-o", "a.png", "--size", "256", "--spp", "65536"});
        Run run = run_bake(folder, endless, {.seconds = 60, .interrupt_after = 1});
        CAPTURE(run.err);
        CHECK(run.code == 130);
        CHECK(run.err.find("a.png: interrupted; written with ") != std::string::npos);
        CHECK(run.out.find("a.png: 256 x 256, ") == 0);
        CHECK(folder.names() == std::set<std::string>{"a.png"});
        CHECK(read_image_info(folder / "a.png").width == 256);
        write_file(folder / "a.png", "old");
        run = run_bake(folder, endless, {.seconds = 60, .interrupt_after = 1, .twice = true});
        CHECK(run.code == 130);
        // The second signal may come when everything is written.
        CHECK(folder.names() == std::set<std::string>{"a.png"});
    }

    TEST_CASE("render --preview: there is a picture long before the end, and nothing beside it") {
        const Folder folder;
        const Run run = run_bake(folder, render(torus, {"-o", "a.png", "--size", "64", "--spp", "65536", "--preview"}),
                                 {.seconds = 2, .signal = SIGKILL});
        CHECK(run.code == 128 + SIGKILL); // so that nothing was written in the end
        CHECK(read_image_info(folder / "a.png").width == 64);
        const auto plain = render(torus, {"-o", "plain.png", "--size", "64", "--spp", "6"});
        REQUIRE(run_bake(folder, plain).code == 0);
        REQUIRE(run_bake(folder, render(torus, {"-o", "a.png", "--size", "64", "--spp", "6", "--preview"})).code == 0);
        CHECK((contents(folder / "a.png") == contents(folder / "plain.png")));
    }

    TEST_CASE("render --display: a viewer sees the picture that is written") {
        const Folder folder;
        LoopbackViewer viewer;
        const Run run = run_bake(folder, render(scene, {"-o", "a.exr", "--depth", "float", "--size", "50x20", "--spp",
                                                        "3", "--crop", "3,2,40,17", "--display", viewer.address()}));
        REQUIRE_MESSAGE(run.code == 0, run.err);
        const ShownPicture shown = viewer.wait();
        CHECK(shown.name == "a.exr");
        const Image<float> image = read_image(folder / "a.exr");
        REQUIRE(shown.width == 40);
        REQUIRE(shown.values.size() == image.size());
        CHECK(std::equal(shown.values.begin(), shown.values.end(), image.data()));
        CHECK(shown.updates == 3 * 2 * 3); // 3 passes of 3 x 2 tiles
        const std::string closed = LoopbackViewer().address();
        check_refused(folder, render(scene, {"-o", "b.exr", "--display", closed}), 5,
                      "cannot be reached (Connection refused)");
    }

    TEST_CASE("render --pixel: its numbers add up to the pixel of the picture") {
        const Folder folder;
        const std::vector<std::string> same = {"--size", "60x40", "--spp", "5"};
        std::vector<std::string> picture = {"-o", "a.exr", "--depth", "float"};
        picture.insert(picture.end(), same.begin(), same.end());
        REQUIRE(run_bake(folder, render(gallery, picture)).code == 0);
        picture[1] = "a.png", picture[3] = "8";
        REQUIRE(run_bake(folder, render(gallery, picture)).code == 0);
        const Image<float> linear = read_image(folder / "a.exr"), shown = read_image(folder / "a.png");
        for (const char* pixel : {"30,20", "10,25", "0,0", "59,39"}) {
            CAPTURE(std::string(pixel));
            std::vector<std::string> arguments = same;
            arguments.insert(arguments.end(), {"--pixel", pixel, "--json"});
            const nlohmann::json route = json_of(run_bake(folder, render(gallery, arguments)));
            const int x = std::atoi(pixel), y = std::atoi(std::strchr(pixel, ',') + 1);
            const std::vector<double> radiance = values(route, "radiance"), levels = values(route, "8 bit");
            REQUIRE(radiance.size() == 3);
            for (int c = 0; c < 3; ++c) {
                CHECK(float(radiance[std::size_t(c)]) == linear.at(x, y, c));
                CHECK(long(levels[std::size_t(c)]) == std::lround(shown.at(x, y, c) * 255));
                double sum = 0;
                for (const char* part : {"emission, ambient", "lights and sky", "reflections", "sky behind"})
                    sum += values(route, part).at(std::size_t(c));
                CHECK(sum == doctest::Approx(radiance[std::size_t(c)]).epsilon(1e-5));
            }
            arguments.pop_back();
            const Run run = run_bake(folder, render(gallery, arguments));
            CHECK(run.out.find("tone: the value in a .png\n") != std::string::npos);
        }
        check_refused(folder, render(gallery, {"--pixel", "60,0", "--size", "60x40"}), 2, "60 x 40");
    }

    TEST_CASE("render --layers --halves: two halves beside their mean") {
        const Folder folder;
        REQUIRE(
            run_bake(folder, render(scene, {"-o", "a.exr", "--size", "20x12", "--spp", "4", "--layers", "--halves"}))
                .code == 0);
        const std::string file = contents(folder / "a.exr");
        for (const std::string channel :
             {"half_a.R", "half_b.B", "samples.Y", "material.Y", "object.Y", "N.X", "P.Z", "Z", "uv.X", "diffuse.G"})
            CHECK_MESSAGE(file.find(channel + '\0') != std::string::npos, channel);
    }

    TEST_CASE("render: pictures of 8 and 16 bits are tagged as sRGB") {
        const Folder folder;
        for (const char* depth : {"8", "16"}) {
            REQUIRE(run_bake(folder, render(scene, {"-o", "a.png", "--size", "8", "--depth", depth})).code == 0);
            CHECK(contents(folder / "a.png").find("sRGB") != std::string::npos);
        }
    }

    TEST_CASE("render: options of sampling that contradict each other are refused") {
        const Folder folder;
        const auto refused = [&](std::vector<std::string> more, const char* named) {
            check_refused(folder, render(scene, more), 2, named);
        };
        refused({"-o", "a.png", "--noise", "0"}, "--noise");
        refused({"-o", "a.png", "--noise", "nan"}, "--noise");
        refused({"-o", "a.png", "--time-limit", "0"}, "--time-limit");
        refused({"-o", "a.png", "--time-limit", "-1"}, "--time-limit");
        refused({"-o", "a.png", "--halves"}, "--layers");
        refused({"-o", "a.png", "--display", "::1"}, "--display");
        refused({"--pixel", "1"}, "--pixel");
        refused({"--pixel", "1,-1"}, "--pixel");
        refused({"--pixel", "1,2,3"}, "--pixel");
        refused({"--pixel", "1,2", "-o", "a.png"}, "--out");
        refused({"--pixel", "1,2", "--noise", "0.1"}, "--noise");
        refused({}, "--out");
    }

} // TEST_SUITE
