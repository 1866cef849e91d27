#include "bake/preview/scene.h"
#include "bake/base/error.h"
#include "bake/base/pages.h"
#include "bake/base/text.h"
#include "bake/base/vec.h"
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace bake {
namespace {

glm::dmat3 linear_part(const Placement& placement) {
    glm::dmat4 m(1);
    const Vec3d angle = Vec3d(placement.rotate_deg) * (pi / 180.0);
    m = glm::rotate(m, angle.z, Vec3d(0, 0, 1));
    m = glm::rotate(m, angle.y, Vec3d(0, 1, 0));
    m = glm::rotate(m, angle.x, Vec3d(1, 0, 0));
    return glm::dmat3(glm::scale(m, Vec3d(placement.scale)));
}

Vec3f to_world(const Instance& instance, const Vec3f& p) noexcept { return instance.linear * p + instance.translate; }

/// The centre of the meshes, if it is farther from 0 than they extend; else 0.
Vec3f far_centre(const Bounds& box) noexcept {
    const Vec3d centre = 0.5 * (Vec3d(box.min) + Vec3d(box.max));
    return glm::length(centre) > diagonal(box) ? Vec3f(centre) : Vec3f(0);
}

/// The triangles of an instance relative to an origin.
BvhMesh placed_mesh(const Instance& instance, const Vec3d& origin) {
    const Mesh& mesh = instance.shape->mesh;
    BvhMesh out;
    resize_in_pages(out.positions, mesh.positions.size() + 1); // and the one that the Bvh pads them with
    out.positions.clear();
    const glm::dmat3 linear(instance.linear);
    const Vec3d translate(instance.translate);
    for (const Vec3f& p : mesh.positions) {
        // Rounded to float only after the origin is subtracted.
        const Vec3d world = linear * Vec3d(p) + translate;
        if (!(glm::length(world) <= 1e18))
            throw Error(Refusal::unsuitable,
                        "a mesh extends beyond 1e18 in the scene; give it a smaller scale or translation");
        out.positions.emplace_back(world - origin);
    }
    const std::vector<Triangle>& triangles = instance.shape->surface.triangles;
    resize_in_pages(out.triangles, triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) out.triangles[t][k] = mesh.corner_position[triangles[t].corner[k]];
    const bool mirrored = glm::determinant(instance.linear) < 0;
    const auto& maps = instance.material->maps;
    out.passes_seen = seen_filter(maps, *instance.shape, mirrored);
    out.passes_light = light_filter(maps, *instance.shape);
    return out;
}

/// With 24 million triangles the tree for fast rays took 15 CPU seconds and 1 GB more than the quick one, and its rays 0.4
/// microseconds less, so that it pays from about one sample per triangle on. Small meshes have no time to win.
BvhTree tree_for(const RenderSettings& settings, double triangles) noexcept {
    const double samples = double(settings.width) * settings.height * std::max(1, settings.spp);
    return triangles > 8e6 && triangles > samples ? BvhTree::quick : BvhTree::fast;
}

/// Areas of relief are squares of lengths, and their squares underflow.
constexpr float least_relief_size = 1e-10f;

void note_small_relief(Scene& scene) {
    const bool relief = std::any_of(scene.instances.begin(), scene.instances.end(),
                                    [](const Instance& instance) { return has_relief(*instance.material); });
    const double size = diagonal(bounds(scene));
    if (!relief || size == 0 || size >= least_relief_size) return;
    scene.notes.push_back(
        format("the scene is %.2g across: below %g relief is lost in the rounding of floats; scale the "
               "scene up",
               size, double(least_relief_size)));
}

} // namespace

void add_instance(Scene& scene, Shape& shape, const Material& material, const Placement& placement) {
    if (placement.scale.x == 0 || placement.scale.y == 0 || placement.scale.z == 0)
        throw Error(Refusal::unsuitable, "a mesh with scale 0 has no surface; give a scale other than 0");
    if (material.normal_map) add_tangents(shape);
    if (material.height || material.bump_table) add_derivatives(shape.surface);
    const glm::dmat3 linear = linear_part(placement);
    Instance instance;
    instance.shape = &shape;
    instance.material = &material;
    instance.linear = glm::mat3(linear);
    // Only directions matter; dividing by the largest entry keeps very small and large scales in the range of float.
    glm::dmat3 normals = glm::transpose(glm::inverse(linear));
    double largest = 0;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(normals[i / 3][i % 3]));
    instance.normals = glm::mat3(normals / largest);
    instance.translate = placement.translate;
    scene.instances.push_back(instance);
}

void build(Scene& scene) {
    scene.origin = far_centre(bounds(scene));
    note_small_relief(scene);
    std::vector<BvhMesh> meshes;
    double triangles = 0;
    for (const Instance& instance : scene.instances) {
        meshes.push_back(placed_mesh(instance, Vec3d(scene.origin)));
        triangles += double(meshes.back().triangles.size());
    }
    scene.bvh.emplace(std::move(meshes), tree_for(scene.settings, triangles));
    scene.sky_light = SkyLight(scene.sky);
    add_mips(scene.materials, scene.settings.filter);
    scene.textured = std::any_of(scene.materials.begin(), scene.materials.end(),
                                 [](const auto& material) { return has_textures(*material); });
    scene.sky.halvings.clear();
    if (scene.settings.filter != TextureFilter::off) add_halvings(scene.sky);
    scene.textured = scene.textured || !scene.sky.halvings.empty();
    if (scene.settings.sky_light == SkyLighting::irradiance && !scene.sky.cube.empty())
        complete(scene.sky_levels, scene.sky.cube);
}

CameraFrame camera_frame(const Scene& scene) noexcept {
    CameraFrame frame = camera_frame(scene.camera);
    frame.position -= scene.origin;
    return frame;
}

Bounds bounds(const Scene& scene) noexcept {
    Bounds box;
    bool first = true;
    for (const Instance& instance : scene.instances)
        for (const Vec3f& p : instance.shape->mesh.positions) {
            const Vec3f world = to_world(instance, p);
            box.min = first ? world : glm::min(box.min, world);
            box.max = first ? world : glm::max(box.max, world);
            first = false;
        }
    return box;
}

Camera framing_camera(const Bounds& box, float fov_deg, float aspect) noexcept {
    Camera camera;
    camera.fov_deg = fov_deg;
    const double radius = 0.5 * diagonal(box);
    if (!(radius > 0)) {
        camera.position = box.min;
        camera.target = box.min + Vec3f(0, 0, 1);
        return camera;
    }
    camera.target = 0.5f * box.min + 0.5f * box.max;
    const Vec3d from = unit_or_zero(Vec3d(0.45, 0.35, 1.0));
    camera.position = camera.target + Vec3f(from * radius);
    const CameraFrame frame = camera_frame(camera);
    double distance = 0; // smallest distance at which all corners are in the picture
    for (int i = 0; i < 8; ++i) {
        const Vec3d corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z);
        const Vec3d d = corner - Vec3d(camera.target);
        const double right = glm::dot(d, Vec3d(frame.right)) / aspect, up = glm::dot(d, Vec3d(frame.up));
        const double side = std::max(std::abs(right), std::abs(up));
        distance = std::max(distance, side / frame.half_height - glm::dot(d, Vec3d(frame.forward)));
    }
    camera.position = Vec3f(Vec3d(camera.target) + from * (1.05 * distance));
    return camera;
}

} // namespace bake
