#include "bake/base/error.h"
#include "bake/base/vec.h"
#include "bake/preview/camera_entry.h"
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

std::string refusal_of(const std::vector<CameraEntry>& cameras, const std::string& name) {
    try {
        find_camera(cameras, name, "a.toml");
    } catch (const Error& error) {
        CHECK(error.refusal == Refusal::usage);
        return error.what();
    }
    FAIL("found");
    return "";
}

CameraEntry named(const std::string& name) {
    CameraEntry entry;
    entry.name = name;
    return entry;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("find_camera: by the whole name; a refusal tells the nearest name, or all names") {
        const std::vector<CameraEntry> cameras = {named("front"), named(""), named("top")};
        CHECK(find_camera(cameras, "front", "a.toml") == 0);
        CHECK(find_camera(cameras, "top", "a.toml") == 2);
        CHECK(refusal_of(cameras, "frnt").find("did you mean \"front\"?") != std::string::npos);
        CHECK(refusal_of(cameras, "perspective").find("its cameras are front, top") != std::string::npos);
        CHECK(refusal_of({}, "front").find("no camera with a name") != std::string::npos);
    }

    TEST_CASE(
        "place_camera: an orthographic camera without height shows the whole box, with 5 % to spare on one axis") {
        const Bounds box{{-1, 0, 2}, {3, 5, 4}};
        for (const float aspect : {0.5f, 1.0f, 3.0f})
            for (const bool placed : {false, true}) {
                CameraEntry entry;
                entry.orthographic = true;
                if (placed) entry.position = Vec3f(10, 20, 30);
                const Camera camera = place_camera(entry, box, aspect);
                const CameraFrame frame = camera_frame(camera);
                double right = 0, up = 0, nearest = 1e9;
                for (int i = 0; i < 8; ++i) {
                    const Vec3f corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                                       i & 4 ? box.max.z : box.min.z);
                    right = std::max(right, std::abs(double(glm::dot(corner - camera.target, frame.right))));
                    up = std::max(up, std::abs(double(glm::dot(corner - camera.target, frame.up))));
                    nearest = std::min(nearest, double(glm::dot(corner - camera.position, frame.forward)));
                }
                const double half = 0.5 * camera.view_height;
                CHECK(std::max(right / aspect, up) == doctest::Approx(half / 1.05));
                CHECK(nearest > 0); // the camera is outside of the box
            }
    }

    TEST_CASE("place_camera: what the entry gives is taken") {
        CameraEntry entry;
        entry.position = Vec3f(1, 2, 3), entry.target = Vec3f(4, 5, 6), entry.up = Vec3f(0, 0, 1);
        entry.fov_deg = 25;
        const Camera camera = place_camera(entry, {{-1, -1, -1}, {1, 1, 1}}, 1.5f);
        CHECK(camera.position == Vec3f(1, 2, 3));
        CHECK(camera.target == Vec3f(4, 5, 6));
        CHECK(camera.up == Vec3f(0, 0, 1));
        CHECK(camera.fov_deg == 25);
        CHECK(!camera.orthographic);
        entry.orthographic = true, entry.height = 7;
        CHECK(place_camera(entry, {}, 1.5f).view_height == 7);
        CHECK(place_camera(entry, {}, 1.5f).orthographic);
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("place_camera: an empty box has a camera with valid axes and a positive height") {
        CameraEntry entry;
        entry.orthographic = true;
        const Camera camera = place_camera(entry, {}, 1);
        CHECK(camera.view_height > 0);
        CHECK(glm::length(camera_frame(camera).right) == doctest::Approx(1));
    }

} // TEST_SUITE
