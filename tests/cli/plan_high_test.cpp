// bake plan of a scene that names a high-poly mesh, from outside.
#include "bake/picture/image_io.h"
#include "bake/verdict/plan/manifest.h"
#include "cli/command.h"
#include "preview/bumpy_square.h"
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Image<float> rendered(const Folder& folder, const std::string& scene) {
    const Run run = run_bake(folder, {"render", scene, "-o", scene + ".exr", "--quiet"});
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return read_image(folder / (scene + ".exr"));
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("plan: the normal map of a high-poly mesh is in the planned scene and in the manifest, whose bake shows "
              "the same") {
        const Folder folder;
        write_bumpy_square(folder);
        const std::string scene = bumpy_scene(from_near);
        write_file(folder / "s.toml", scene);
        const std::vector<std::string> line = {"plan", "s.toml", "--budget", "rmse=0.015", "-o", "p.toml"};
        const auto with = [&](std::vector<std::string> more) {
            more.insert(more.begin(), line.begin(), line.end());
            return more;
        };
        const Run text = run_bake(folder, with({"--manifest", "b.toml", "--report", "p.html", "--verify"}));
        REQUIRE_MESSAGE(text.code == 0, text.err);
        for (const char* part : {"of the high-poly mesh\n", "  square           normal ", "    high-poly    high.obj\n",
                                 "normal is enough: 2 triangles with a normal map of 64 x 64 texels differ by rmse 0.",
                                 "    cheaper      plain: rmse 0.", "    dearer       high: ", "against high: "})
            CHECK_MESSAGE(has(text.out, part), part << "\n" << text.out);
        const auto json = nlohmann::json::parse(run_bake(folder, with({"--json", "--threads", "1"})).out);
        CHECK(json["objects"][0]["high"] == "high.obj");
        CHECK(json["objects"][0]["model"] == "normal");
        CHECK(json["objects"][0]["facts"].empty());
        CHECK(has(contents(folder / "p.toml"), "high = \"high.obj\" # 2048 triangles\nshade = \"normal\"\n"));

        const auto bakes = parse_manifest(contents(folder / "b.toml"), "b.toml").bakes;
        REQUIRE(bakes.size() == 1);
        const Run bake = run_bake(folder, command_of(bakes[0]));
        REQUIRE_MESSAGE(bake.code == 0, bake.err);
        std::string baked = scene;
        const std::string high = "high = \"high.obj\" # 2048 triangles\nnormal-size = 64\n";
        baked.erase(baked.find(high), high.size());
        baked.replace(baked.find("diffuse"), 0, "normal = \"" + bakes[0].outputs.front().second + "\"\n");
        write_file(folder / "baked.toml", baked);
        const Image<float> a = rendered(folder, "p.toml"), b = rendered(folder, "baked.toml");
        REQUIRE(a.size() == b.size());
        double most = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            most = std::max(most, std::abs(double(a.data()[i]) - double(b.data()[i])));
        CHECK(most < 1e-3); // the map's 16 bits
    }

    TEST_CASE("plan and render: a high-poly mesh that is missing is told with its line") {
        const Folder folder;
        write_bumpy_square(folder);
        fs::remove(folder / "high.obj");
        write_file(folder / "s.toml", bumpy_scene(from_near));
        const std::string why = "s.toml:16: high.obj: no such file";
        check_refused(folder, {"render", "s.toml", "-o", "out.png"}, 3, why);
        check_refused(folder, {"plan", "s.toml", "-o", "out.toml"}, 3, why);
    }
}
