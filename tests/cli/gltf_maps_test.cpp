// Which materials of a glTF file get the map of bake normal-map.
#include "bake/mesh/gltf/io.h"
#include "cli/gltf_parts.h"
#include "cli/gltf_validator.h"
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;
using nlohmann::json;

namespace {

const std::string bricks = (own_meshes() / "bricks.png").string();

struct Baked {
    json root; ///< of out.gltf
    std::string err;
};

Baked baked(const Folder& folder, const std::vector<SquarePart>& parts, const std::vector<std::string>& materials,
            const std::vector<std::string>& options = {}) {
    write_file(folder / "a.gltf", square_parts(parts, materials));
    std::vector<std::string> all = {"normal-map", "a.gltf", "--height", bricks, "--amplitude",
                                    "1%",         "--size", "32",       "-o",   "out.gltf"};
    all.insert(all.end(), options.begin(), options.end());
    const Run run = run_bake(folder, all);
    REQUIRE_MESSAGE(run.code == 0, run.err);
    if (!no_validator()) CHECK(validator_says(folder.path) == "");
    return {json::parse(contents(folder / "out.gltf")), run.err};
}

const json& primitive(const json& root, int number) { return root["meshes"][0]["primitives"][number]; }

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("gltf maps: a material whose faces lack the set of uvs gets no map, and a note says so") {
        const Folder folder;
        const Baked of_set = baked(folder, {{{0, 1}, 0}, {{0}, 1}}, {"a", "b"}, {"--uv-set", "1"});
        CHECK(of_set.root["materials"].size() == 2);
        CHECK(of_set.root["materials"][0]["normalTexture"]["texCoord"] == 1);
        CHECK(!of_set.root["materials"][1].contains("normalTexture"));
        CHECK(of_set.err.find("the material 'b' gets no map: its faces have no uvs of the map") != std::string::npos);
        const Baked without = baked(folder, {{{}, 0}, {{0}, 1}}, {"a", "b"});
        CHECK(!without.root["materials"][0].contains("normalTexture"));
        CHECK(without.root["materials"][1].contains("normalTexture"));
        CHECK(baked(folder, {{{0}, 0}, {{0}, 1}}, {"a", "b"}).err.find("gets no map") == std::string::npos);
    }

    TEST_CASE("gltf maps: of primitives that share a material, those without uvs keep it as it was") {
        const Folder folder;
        const Baked shared = baked(folder, {{{0}, 0}, {{}, 0}, {{}, 0}, {{0}, 1}}, {"a", "b"});
        REQUIRE(shared.root["materials"].size() == 3);
        CHECK(shared.root["materials"][0].contains("normalTexture"));
        CHECK(shared.root["materials"][2] == json{{"name", "a without uvs"}});
        CHECK(primitive(shared.root, 0)["material"] == 0);
        CHECK(primitive(shared.root, 1)["material"] == 2);
        CHECK(primitive(shared.root, 2)["material"] == 2);
        CHECK(primitive(shared.root, 3)["material"] == 1);
        CHECK(shared.err.find("the material 'a' has become two: 2 primitives without uvs of the map keep it as it "
                              "was") != std::string::npos);
        // Without a material there is nothing to keep.
        const Baked bare = baked(folder, {{{0}, -1}, {{}, -1}}, {});
        CHECK(bare.root["materials"].size() == 1);
        CHECK(primitive(bare.root, 0)["material"] == 0);
        CHECK(!primitive(bare.root, 1).contains("material"));
    }

    TEST_CASE("gltf maps: a mesh of another format has maps on the materials that have uvs") {
        const Folder folder;
        write_file(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 3 1 0\nv 2 1 0\n"
                                     "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3 4/4\n"
                                     "usemtl b\nf 5 6 7 8\n");
        const Run run = run_bake(
            folder, {"normal-map", "a.obj", "--height", bricks, "--amplitude", "1%", "--size", "32", "-o", "out.gltf"});
        REQUIRE_MESSAGE(run.code == 0, run.err);
        const json root = json::parse(contents(folder / "out.gltf"));
        CHECK(root["materials"][0].contains("normalTexture"));
        CHECK(!root["materials"][1].contains("normalTexture"));
        if (!no_validator()) CHECK(validator_says(folder.path) == "");
    }
}
