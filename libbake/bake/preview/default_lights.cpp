#include "bake/preview/default_lights.h"

namespace bake {
namespace {

/// `from` is along the right, the up and the backward axis of the camera.
void add_light(Scene& scene, const Vec3f& from, const Vec3f& colour) {
    const CameraFrame frame = camera_frame(scene.camera);
    Light<float> light;
    light.from = unit_or_zero(from.x * frame.right + from.y * frame.up - from.z * frame.forward);
    light.colour = colour;
    scene.lights.push_back(light);
}

} // namespace

void add_default_light(Scene& scene) { add_light(scene, {-0.7f, 1.0f, 0.9f}, Vec3f(1)); }

void add_studio_lights(Scene& scene) {
    add_light(scene, {-0.8f, 0.9f, 0.7f}, {0.9f, 0.87f, 0.82f});
    add_light(scene, {1.0f, 0.15f, 0.6f}, {0.17f, 0.19f, 0.23f});
    add_light(scene, {0.6f, 0.8f, -1.0f}, {0.45f, 0.47f, 0.5f});
    scene.ambient += Vec3f(0.06f);
}

} // namespace bake
