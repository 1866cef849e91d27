// What is rendered: placed meshes with materials, lights, a camera, a sky.
#pragma once
#include "bake/environment/sky/cube.h"
#include "bake/light/light.h"
#include "bake/preview/material.h"
#include "bake/ray/bvh.h"
#include "bake/ray/camera.h"
#include <glm/mat3x3.hpp>
#include <optional>

namespace bake {

/// From object to world: scale first, then turns about x, y and z in that order, then translate.
struct Placement {
    Vec3f translate{0}, rotate_deg{0}, scale{1};
};

/// A shape at a place. Points go as linear p + translate, normals as normals n (the inverse transpose, which keeps the
/// outside outside under mirroring too), tangent vectors with linear.
struct Instance {
    const Shape* shape = nullptr;
    const Material* material = nullptr;
    glm::mat3 linear{1}, normals{1};
    Vec3f translate{0};
};

/// What is seen where nothing is hit.
struct Sky {
    Cube cube;           ///< empty: the background
    float scale = 1;     ///< of the cube's radiance
    Vec3f background{0}; ///< radiance, linear RGB
};

struct RenderSettings {
    int width = 512, height = 512;
    int spp = 4;         ///< samples per pixel; 1 is the pixel's centre
    int bounces = 1;     ///< mirror reflections that meet meshes; further ones see the sky only
    bool shadows = true; ///< of directional and point lights
    float exposure = 0;  ///< stops; for pictures written in 8 or 16 bits, never for EXR
};

/// Owns everything; instances point into shapes and materials, which therefore keep their addresses.
struct Scene {
    std::vector<std::unique_ptr<Shape>> shapes;
    std::vector<std::unique_ptr<Material>> materials;
    std::vector<Instance> instances;
    std::vector<Light<float>> lights;
    Vec3f ambient{0}; ///< light that comes from everywhere
    Camera camera;
    Sky sky;
    RenderSettings settings;
    std::optional<Bvh> bvh; ///< after build; mesh i is instance i, its triangles those of the shape's surface
};

/// Throws Error{Refusal::unsuitable} for a scale of 0 along an axis. Prepares the shape for the material (tangents).
void add_instance(Scene& scene, Shape& shape, const Material& material, const Placement& placement = {});
/// Builds the Bvh: after the last add_instance, before rendering. Throws Error{Refusal::unsuitable} when a placed
/// position is not finite or beyond 1e18.
void build(Scene& scene);

/// World-space bounding box of all instances; both zero without any.
Bounds bounds(const Scene& scene) noexcept;
/// A camera that sees the whole box from the front, a little from above and the right; at the origin looking along +Z
/// when the box is empty.
Camera framing_camera(const Bounds& box, float fov_deg, float aspect) noexcept;

/// Radiance of the sky along a world-space direction.
Vec3f sky_radiance(const Sky& sky, const Vec3f& direction) noexcept;

} // namespace bake
