// bake render of glTF files with their own materials and lights.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

const std::string still_life = own_meshes() / "still_life.glb";

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("render: a glTF with its own materials and lights, the same for any number of threads, without a NaN") {
        const Folder folder;
        const std::vector<std::string> view = {"--camera", "front", "--size",  "96x48",
                                               "--spp",    "2",     "--depth", "float"};
        const auto render = [&](const char* out, const char* threads, const std::vector<std::string>& more = {}) {
            std::vector<std::string> all = {"render", still_life, "-o", out, "--threads", threads};
            all.insert(all.end(), view.begin(), view.end());
            all.insert(all.end(), more.begin(), more.end());
            return run_bake(folder, all);
        };
        const Run one = render("a.exr", "1");
        REQUIRE_MESSAGE(one.code == 0, one.err);
        CHECK(one.err.find("material 'pane': is blended") != std::string::npos);
        REQUIRE(render("b.exr", "3").code == 0);
        CHECK(contents(folder / "a.exr") == contents(folder / "b.exr"));
        const Image<float> seen = read_image(folder / "a.exr");
        double red = 0, blue = 0;
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 96; ++x) {
                for (int c = 0; c < 3; ++c) CHECK(std::isfinite(seen.at(x, y, c)));
                red += double(seen.at(x, y, 0)), blue += double(seen.at(x, y, 2));
            }
        CHECK(red > 1.2 * blue); // warm
        REQUIRE(render("c.exr", "2", {"--material", "diffuse=.5"}).code == 0);
        const Image<float> grey = read_image(folder / "c.exr");
        bool differs = false;
        for (std::size_t i = 0; i < grey.size(); ++i) differs = differs || grey.data()[i] != seen.data()[i];
        CHECK(differs);
    }

} // TEST_SUITE
TEST_SUITE("real" * doctest::skip(no_shared_data())) {

    TEST_CASE("render: NormalTangentTest and armor, under a sky") {
        const Folder folder;
        for (const char* file : {"NormalTangentTest.glb", "armor.gltf"}) {
            CAPTURE(file);
            const Run run = run_bake(folder, {"render", shared_data() / "meshes/gltf" / file, "-o", "a.exr", "--size",
                                              "48", "--spp", "2", "--sky", own_meshes() / "sky_%s.png"});
            REQUIRE_MESSAGE(run.code == 0, run.err);
            const Image<float> seen = read_image(folder / "a.exr");
            for (std::size_t i = 0; i < seen.size(); ++i) CHECK(std::isfinite(seen.data()[i]));
        }
    }

} // TEST_SUITE
