// A scene: mesh instances with materials, lights, a camera, a sky.
#pragma once
#include "bake/light/light.h"
#include "bake/preview/material.h"
#include "bake/preview/sky.h"
#include "bake/preview/sky_levels.h"
#include "bake/preview/terminator.h"
#include "bake/preview/tone.h"
#include "bake/ray/bvh.h"
#include "bake/ray/camera.h"
#include <glm/mat3x3.hpp>
#include <optional>

namespace bake {

/// Transform from object to world space: scale, then rotation about x, y and z in that order, then translation.
struct Placement {
    Vec3f translate{0}, rotate_deg{0}, scale{1};
};

/// A placed shape. Points are transformed by linear p + translate, tangent vectors by linear, normals by the matrix `normals`.
/// The latter is the inverse transpose of linear, which keeps normals outward under mirroring.
struct Instance {
    const Shape* shape = nullptr;
    const Material* material = nullptr;
    glm::mat3 linear{1}, normals{1};
    Vec3f translate{0};
};

/// Whether the sky lights meshes, or is only seen and mirrored.
enum class SkyLighting {
    off,
    sampled,
    irradiance, ///< as in real-time engines: from filtered levels of the sky, without shadows
};

/// Pixels x to x + width, y to y + height of a picture.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;
};

struct RenderSettings {
    int width = 512, height = 512;
    std::optional<PixelRect> part; ///< the only pixels that are rendered; none: all
    int spp = 4;                   ///< samples per pixel; 1 is the pixel's centre
    int bounces = 1;               ///< mirror, glossy and refracted rays that can hit meshes, one after the other
    int diffuse_bounces = 0;       ///< the same for diffuse reflections; needs a sky that lights
    bool shadows = true; ///< whether meshes shadow lights and sky, and are seen by glossy and diffuse reflections
    SkyLighting sky_light = SkyLighting::sampled;
    Terminator terminator = Terminator::off;
    TextureFilter filter = TextureFilter::moments; ///< of textures and of the sky that rays see; set before build()
    std::uint32_t seed = 0;                        ///< pictures of different seeds have independent noise
    std::optional<float> exposure; ///< in stops, for pictures written in 8 or 16 bits; none: automatic_exposure()
    Tone tone = Tone::srgb;
};

/// Owns its parts. Instances point to shapes and materials, whose addresses do not change.
struct Scene {
    std::vector<std::unique_ptr<Shape>> shapes;
    std::vector<std::unique_ptr<Material>> materials;
    std::vector<Instance> instances;
    std::vector<Light<float>> lights;
    Vec3f ambient{0}; ///< radiance of ambient light
    Camera camera;
    Sky sky;
    RenderSettings settings;
    std::vector<std::string> notes; ///< of reading the files, with their names
    SkyLight sky_light;             ///< set by build()
    bool textured = false;          ///< set by build(): materials or a sky are looked up over the cones of rays
    SkyLevels sky_levels;           ///< completed by build() for SkyLighting::irradiance
    /// Set by build(): the positions of the Bvh, and the rays of radiance(), are relative to this point. It is 0 unless the
    /// meshes lie farther from 0 than they extend, where floats would be too coarse for them.
    Vec3f origin{0};
    std::optional<Bvh> bvh; ///< set by build(); mesh i is instance i with the triangles of the shape's surface
};

/// Adds to the shape what the material needs: tangents for a normal map, derivatives for a height or a bump table. Throws Error{Refusal::unsuitable} for a scale of 0 along an
/// axis.
void add_instance(Scene& scene, Shape& shape, const Material& material, const Placement& placement = {});
/// Builds the Bvh and the light of the sky. Call it after the last add_instance() and before rendering. Throws Error{Refusal::unsuitable} if a world
/// position is not finite or beyond 1e18.
void build(Scene& scene);
/// The frame of the scene's camera, relative to scene.origin: its rays are those of radiance().
CameraFrame camera_frame(const Scene& scene) noexcept;

/// World-space bounding box of all instances; zero without instances.
Bounds bounds(const Scene& scene) noexcept;
/// A camera that sees the whole box from the front, slightly from above and from the right. If the box is empty, the camera
/// looks along +Z.
Camera framing_camera(const Bounds& box, float fov_deg, float aspect) noexcept;

} // namespace bake
