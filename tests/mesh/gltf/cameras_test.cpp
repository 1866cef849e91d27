#include "bake/base/error.h"
#include "bake/mesh/gltf/cameras.h"
#include "cli/command.h"
#include <doctest/doctest.h>

using namespace bake;
using bake::test::Folder;

namespace {

std::vector<GltfCamera> read(const Folder& folder, const std::string& members) {
    test::write_file(folder / "a.gltf", R"({"asset": {"version": "2.0"}, )" + members + "}");
    return read_gltf_cameras(folder / "a.gltf");
}

const std::string two = R"("cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}},
    {"type": "orthographic", "name": "plan", "orthographic": {"xmag": 4, "ymag": 3, "znear": 0, "zfar": 9}}])";

double apart(const Vec3d& a, const Vec3d& b) { return glm::length(a - b); }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("read_gltf_cameras: place, direction, kind and size, under the nodes above") {
        const Folder folder;
        // The parent moves by (0, 10, 0) and turns +X to +Y, about z by 90 degrees; both are scaled by 2.
        const std::vector<GltfCamera> cameras = read(folder, two + R"(, "nodes": [
            {"name": "eye", "camera": 0, "translation": [1, 2, 3]},
            {"children": [3], "translation": [0, 10, 0], "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752]},
            {"camera": 0},
            {"camera": 1, "translation": [5, 0, 0], "scale": [2, 2, 2]}])");
        REQUIRE(cameras.size() == 3);
        CHECK(cameras[0].name == "eye");
        CHECK(cameras[0].position == Vec3d(1, 2, 3));
        CHECK(cameras[0].forward == Vec3d(0, 0, -1));
        CHECK(cameras[0].up == Vec3d(0, 1, 0));
        CHECK(!cameras[0].orthographic);
        CHECK(cameras[0].fov == 0.5);
        CHECK(cameras[1].name == "camera_2");
        CHECK(cameras[2].name == "plan");
        CHECK(cameras[2].orthographic);
        CHECK(cameras[2].height == 6);
        CHECK(apart(cameras[2].position, {0, 15, 0}) < 1e-12);
        CHECK(apart(cameras[2].forward, {0, 0, -1}) < 1e-12);
        CHECK(apart(cameras[2].up, {-1, 0, 0}) < 1e-12);
    }

    TEST_CASE("read_gltf_cameras: a camera that looks along +X") {
        const Folder folder;
        const std::vector<GltfCamera> cameras =
            read(folder,
                 two + R"(, "nodes": [{"camera": 0, "rotation": [0, -0.70710678118654752, 0, 0.70710678118654752]}])");
        REQUIRE(cameras.size() == 1);
        CHECK(apart(cameras[0].forward, {1, 0, 0}) < 1e-12);
    }

    TEST_CASE("read_gltf_cameras: none in a file without cameras or without nodes") {
        const Folder folder;
        CHECK(read(folder, R"("nodes": [{}])").empty());
        CHECK(read(folder, two).empty());
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("read_gltf_cameras: faults of cameras and their nodes are refused with the file") {
        const Folder folder;
        for (const std::string members :
             {R"("nodes": [{"camera": 0}])", R"("cameras": [{}], "nodes": [{"camera": 0}])",
              R"("cameras": [3], "nodes": [{"camera": 0}])", R"("cameras": [{}], "nodes": [{"camera": -1}])",
              R"("cameras": [{"perspective": {"yfov": 0}}], "nodes": [{"camera": 0}])",
              R"("cameras": [{"perspective": {"yfov": "wide"}}], "nodes": [{"camera": 0}])",
              R"("cameras": [{"perspective": {"yfov": 1}}], "nodes": [{"camera": 0, "scale": [0, 0, 0]}])",
              R"("cameras": [{"perspective": {"yfov": 1}}], "nodes": [{"camera": 0, "translation": [1e300, 0, 0]}])",
              R"("cameras": [{"perspective": {"yfov": 1}}], "nodes": [{"camera": 0, "translation": ["a", 0, 0]}])",
              R"("cameras": [{"perspective": {"yfov": 1}}], "nodes": [{"camera": 0, "children": [7]}])",
              R"("cameras": [{"perspective": {"yfov": 1}}], "nodes": [{"camera": 0, "children": ["a"]}])"}) {
            CAPTURE(members);
            bool refused = false;
            try {
                read(folder, members);
            } catch (const Error& error) {
                refused = true;
                CHECK(error.refusal == Refusal::unreadable);
                CHECK(std::string(error.what()).rfind(folder / "a.gltf: ", 0) == 0);
            }
            CHECK(refused);
        }
    }

    TEST_CASE("read_gltf_cameras: nodes in a circle do not matter to cameras elsewhere") {
        const Folder folder;
        CHECK(read(folder, two + R"(, "nodes": [{"camera": 0}, {"children": [2]}, {"children": [1]}])").size() == 1);
    }

} // TEST_SUITE
