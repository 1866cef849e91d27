// bake normal-map --residual-of with -o asset: the displaced mesh with its map.
#include "bake/mesh/gltf/io.h"
#include "bake/picture/image_io.h"
#include "cli/displacing.h"
#include "cli/gltf_parts.h"
#include "cli/gltf_validator.h"
#include <charconv>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

/// Displaces a square, and bakes its residual map into a file.
Run residual(const Folder& folder, const std::string& displaced, const std::string& out,
             const std::vector<std::string>& options = {}) {
    std::vector<std::string> all = {"normal-map", "a.gltf", "--height",      waves(folder), "--amplitude", "0.2",
                                    "--size",     "32",     "--residual-of", displaced,     "-o",          out};
    all.insert(all.end(), options.begin(), options.end());
    return run_bake(folder, all);
}

std::string shortest(float value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("residual asset: -o asset.glb and .usda are the displaced mesh with the map that is relative to it") {
        const Folder folder;
        write_file(folder / "a.gltf", square_parts({{{0}, 0}}, {"tiles"}));
        displaced(folder, {"a.gltf", "--height", waves(folder), "--amplitude", "0.2", "--levels", "2", "-o", "d.glb"});
        const Run run = residual(folder, "d.glb", "r.glb");
        REQUIRE_MESSAGE(run.code == 0, run.err);
        const Gltf before = read_gltf(folder / "d.glb"), after = read_gltf(folder / "r.glb");
        CHECK(after.mesh.faces() == before.mesh.faces());
        CHECK(after.mesh.positions == before.mesh.positions);
        CHECK(after.mesh.tangents.size() == after.mesh.corners());
        REQUIRE(after.materials.size() == 1);
        CHECK(after.materials[0].name == "tiles");
        CHECK(after.materials[0].normal);
        REQUIRE(residual(folder, "d.glb", "n.png", {"--depth", "8"}).code == 0);
        REQUIRE(after.images.size() == 1);
        write_file(folder / "inside.png", std::string(after.images[0].bytes.begin(), after.images[0].bytes.end()));
        const Image<float> inside = read_image(folder / "inside.png"), beside = read_image(folder / "n.png");
        REQUIRE(inside.size() == beside.size());
        CHECK(std::equal(inside.data(), inside.data() + inside.size(), beside.data()));

        REQUIRE(residual(folder, "d.glb", "r.usda").code == 0);
        float highest = 0;
        for (const Vec3f& p : before.mesh.positions) highest = std::max(highest, p.z);
        CHECK(highest > 0.02f);
        CHECK(contents(folder / "r.usda").find(", " + shortest(highest) + ")") != std::string::npos);
        CHECK(residual(folder, "d.glb", "r.mtlx").code == 0);
        if (!no_validator()) CHECK(validator_says(folder.path) == "");

        displaced(folder, {"a.gltf", "--height", waves(folder), "--amplitude", "0.2", "--levels", "2", "-o", "d.ply"});
        REQUIRE(residual(folder, "d.ply", "p.glb").code == 0);
        CHECK(read_gltf(folder / "p.glb").mesh.faces() == before.mesh.faces());
    }

    TEST_CASE("residual asset: a mesh with other uvs is refused, and no file is left") {
        const Folder folder;
        write_file(folder / "a.gltf", square_parts({{{0}, 0}}, {"tiles"}));
        write_file(folder / "other.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt .2 0\nvt .2 .2\nf 1/1 2/2 3/3\n");
        waves(folder);
        check_refused(folder,
                      {"normal-map", "a.gltf", "--height", waves(folder), "--amplitude", "0.2", "--residual-of",
                       "other.obj", "-o", "r.glb"},
                      4, "other.obj: its uvs are not those of a.gltf");
        CHECK(residual(folder, "other.obj", "n.png").code == 0); // a picture is written, with a note
    }

    TEST_CASE("residual: the copy that displace writes of a glTF file is read with the file's v") {
        const Folder folder;
        write_file(folder / "a.gltf", square_parts({{{0}, 0}}, {"tiles"}));
        displaced(folder, {"a.gltf", "--flip-v", "--height", waves(folder), "--amplitude", "0.2", "--levels", "5", "-o",
                           "d.glb"});
        REQUIRE(residual(folder, "d.glb", "n.exr", {"--flip-v"}).code == 0);
        const Image<float> map = read_image(folder / "n.exr");
        float largest = 0;
        for (std::size_t i = 0; i < map.size(); i += 3)
            largest = std::max({largest, std::abs(map.data()[i] - 0.5f), std::abs(map.data()[i + 1] - 0.5f)});
        CHECK(largest < 0.05f);
    }
}
