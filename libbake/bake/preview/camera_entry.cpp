#include "bake/preview/camera_entry.h"
#include "bake/base/error.h"
#include "bake/preview/nearest_key.h"
#include "bake/preview/scene.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Height of the orthographic picture that shows the whole box, and 5 % more.
float fitting_height(const Camera& camera, const Bounds& box, float aspect) noexcept {
    const CameraFrame frame = camera_frame(camera);
    double half = 0;
    for (int i = 0; i < 8; ++i) {
        const Vec3d corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z);
        const Vec3d d = corner - Vec3d(camera.target);
        half = std::max(
            {half, std::abs(glm::dot(d, Vec3d(frame.right))) / aspect, std::abs(glm::dot(d, Vec3d(frame.up)))});
    }
    return half > 0 ? float(2 * 1.05 * half) : 2;
}

} // namespace

std::size_t find_camera(std::span<const CameraEntry> cameras, const std::string& name, const std::string& file) {
    std::vector<std::string> names;
    std::string known;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        if (cameras[i].name == name) return i;
        if (cameras[i].name.empty()) continue;
        names.push_back(cameras[i].name);
        known += (known.empty() ? "" : ", ") + names.back();
    }
    const std::string meant = did_you_mean(name, names);
    throw Error(Refusal::usage, "`camera` " + name + ": is not a camera of " + file + "; " +
                                    (!meant.empty()  ? meant
                                     : names.empty() ? "it has no camera with a name"
                                                     : "its cameras are " + known));
}

Camera place_camera(const CameraEntry& entry, const Bounds& box, float aspect) noexcept {
    // An orthographic camera stands where a perspective one of 40 degrees would: outside of the box.
    Camera camera = framing_camera(box, entry.orthographic ? CameraEntry{}.fov_deg : entry.fov_deg, aspect);
    if (entry.position) camera.position = *entry.position;
    if (entry.target) camera.target = *entry.target;
    camera.up = entry.up;
    camera.fov_deg = entry.fov_deg;
    if (camera.position == camera.target) camera.target.z += 1;
    camera.orthographic = entry.orthographic;
    if (entry.orthographic) camera.view_height = entry.height ? *entry.height : fitting_height(camera, box, aspect);
    return camera;
}

} // namespace bake
