// Rays and spheres of the tests of docs/lecture.md.
#pragma once
#include "preview/little_scenes.h"

namespace bake::test {

/// First intersection with the sphere about the origin; false if there is none.
inline bool on_sphere(const Ray& ray, double radius, Vec3d& p) {
    const Vec3d o(ray.origin), d(glm::normalize(Vec3d(ray.direction)));
    const double b = glm::dot(o, d), root = b * b - glm::dot(o, o) + radius * radius;
    p = o + (-b - std::sqrt(std::max(0.0, root))) * d;
    return root > 0;
}

inline Ray ray_at(const Scene& scene, double x, double y, int n) {
    return primary_ray(camera_frame(scene), x, y, n, n);
}

} // namespace bake::test
