// bake normal-map on meshes whose materials share places of the map, and --material.
#include "bake/picture/image_io.h"
#include "cli/displacing.h"
#include "cli/gltf_parts.h"
#include "cli/gltf_validator.h"
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;
using nlohmann::json;

namespace {

/// Two squares, of sides 1 and 3, that have the whole unit square of the uvs each.
const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 5 0 0\nv 5 3 0\nv 2 3 0\n"
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
const std::string wood = "usemtl wood\nf 1/1 2/2 3/3 4/4\n", metal = "usemtl metal\nf 5/1 6/2 7/3 8/4\n";

Run normal_map(const Folder& folder, const std::string& mesh, const std::vector<std::string>& options) {
    std::vector<std::string> all = {"normal-map", mesh, "--size", "32"};
    all.insert(all.end(), options.begin(), options.end());
    const Run run = run_bake(folder, all);
    REQUIRE_MESSAGE(run.code == 0, run.err);
    return run;
}

Run height_map(const Folder& folder, const std::string& mesh, std::vector<std::string> options) {
    options.insert(options.end(), {"--height", waves(folder), "--amplitude", "0.1"});
    return normal_map(folder, mesh, options);
}

bool same(const Folder& folder, const std::string& a, const std::string& b) {
    const Image<float> first = read_image(folder / a), second = read_image(folder / b);
    return first.size() == second.size() && std::equal(first.data(), first.data() + first.size(), second.data());
}

const std::string overlap =
    ": the charts of the materials 'wood', 'metal' overlap in the uvs, and the map is right for one of them alone";

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("normal-map: materials whose charts overlap are named, whatever is baked and written") {
        const Folder folder;
        write_file(folder / "pair.obj", vertices + wood + metal);
        write_file(folder / "beside.obj",
                   vertices + "vt 2 0\nvt 3 0\nvt 3 1\nvt 2 1\n" + wood + "usemtl metal\nf 5/5 6/6 7/7 8/8\n");
        write_file(folder / "one.obj", vertices + "usemtl metal\nf 1/1 2/2 3/3 4/4\nf 5/1 6/2 7/3 8/4\n");
        const auto told = [](const Run& run) { return run.err.find(overlap) != std::string::npos; };
        CHECK(told(height_map(folder, "pair.obj", {"-o", "n.png"})));
        CHECK(told(height_map(folder, "pair.obj", {"-o", "n.glb"})));
        CHECK(told(normal_map(folder, "pair.obj", {"--high", "pair.obj", "-o", "n.png"})));
        CHECK(told(normal_map(folder, "pair.obj", {"--bevel", "1%", "-o", "n.png"})));
        const Run as_json = height_map(folder, "pair.obj", {"-o", "n.png", "--json"});
        CHECK(json::parse(as_json.out)["notes"].dump().find("--material") != std::string::npos);
        CHECK(!told(height_map(folder, "pair.obj", {"-o", "n.png", "--material", "metal"})));
        CHECK(!told(height_map(folder, "beside.obj", {"-o", "n.png", "--tile", "1003"})));
        CHECK(height_map(folder, "one.obj", {"-o", "n.png"}).err.find("the materials") == std::string::npos);
    }

    TEST_CASE("normal-map: --material bakes the faces of that material as if the others were not there") {
        const Folder folder;
        write_file(folder / "pair.obj", vertices + wood + metal);
        write_file(folder / "wood.obj", vertices + wood);
        write_file(folder / "metal.obj", vertices + metal);
        displaced(folder,
                  {"pair.obj", "--height", waves(folder), "--amplitude", "0.1", "--levels", "2", "-o", "d.obj"});
        for (const std::string material : {"wood", "metal"}) {
            CAPTURE(material);
            for (const std::vector<std::string>& source :
                 {std::vector<std::string>{"--height", waves(folder), "--amplitude", "0.1"},
                  {"--high", "d.obj"},
                  {"--height", waves(folder), "--amplitude", "0.1", "--residual-of", "d.obj"}}) {
                CAPTURE(source.back());
                std::vector<std::string> options = source;
                options.insert(options.end(), {"-o", "chosen.png", "--material", material});
                const Run run = normal_map(folder, "pair.obj", options);
                CHECK(run.err.find("no uvs") == std::string::npos);
                CHECK(run.err.find("more than one face") == std::string::npos);
                options = source;
                options.insert(options.end(), {"-o", "alone.png"});
                if (source.back() == "d.obj") options.insert(options.end(), {"--material", material});
                normal_map(folder, source.back() == "d.obj" ? "pair.obj" : material + ".obj", options);
                CHECK(same(folder, "chosen.png", "alone.png"));
            }
        }
        // The slopes of the larger square are a third.
        height_map(folder, "pair.obj", {"-o", "wood.png", "--material", "wood"});
        height_map(folder, "pair.obj", {"-o", "metal.png", "--material", "metal"});
        CHECK(!same(folder, "wood.png", "metal.png"));
        check_refused(folder,
                      {"normal-map", "pair.obj", "--height", waves(folder), "-o", "n.png", "--material", "stone"}, 4,
                      "pair.obj: no face has the material 'stone'; its materials are 'wood', 'metal'");
        check_refused(folder, {"normal-map", waves(folder), "-o", "n.png", "--material", "wood"}, 2, "--material");
        check_refused(folder,
                      {"normal-map", "pair.obj", "--height", waves(folder), "-o", "n.png", "--material", "wood",
                       "--preview", "p.png"},
                      2, "--preview: ");
    }

    TEST_CASE("normal-map: --material puts the map into that material alone, and another bake adds that of another") {
        const Folder folder;
        write_file(folder / "a.gltf", square_parts({{{0}, 0}, {{0}, 1}}, {"wood", "metal"}));
        height_map(folder, "a.gltf", {"-o", "step.gltf", "--material", "metal"});
        const json step = json::parse(contents(folder / "step.gltf"));
        CHECK(!step["materials"][0].contains("normalTexture"));
        CHECK(step["materials"][1].contains("normalTexture"));
        height_map(folder, "step.gltf", {"-o", "both.gltf", "--material", "wood"});
        const json both = json::parse(contents(folder / "both.gltf"));
        CHECK(both["images"].size() == 2);
        CHECK(both["materials"][0]["normalTexture"]["index"] != both["materials"][1]["normalTexture"]["index"]);
        write_file(folder / "pair.obj", vertices + wood + metal);
        height_map(folder, "pair.obj", {"-o", "pair.gltf", "--material", "metal"});
        CHECK(!json::parse(contents(folder / "pair.gltf"))["materials"][0].contains("normalTexture"));
        if (!no_validator()) CHECK(validator_says(folder.path) == "");
        const auto normals = [&](const std::vector<std::string>& more) {
            std::vector<std::string> options = {"-o", "a.usda"};
            options.insert(options.end(), more.begin(), more.end());
            height_map(folder, "a.gltf", options);
            const std::string text = contents(folder / "a.usda");
            int count = 0;
            for (std::size_t at = 0; (at = text.find("inputs:normal", at)) != std::string::npos; ++at) ++count;
            return count;
        };
        CHECK(normals({}) == 2);
        CHECK(normals({"--material", "wood"}) == 1);
    }
}
