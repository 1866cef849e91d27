// Small scenes whose pictures have noise, in pairs: with and without relief.
#pragma once
#include "bake/preview/pixel_samples.h"
#include "bake/verdict/plan/pixel_probe.h"
#include "preview/little_scenes.h"

namespace bake::test {

/// A ball above a floor under a quad light; the ball has waves of this height. Instance 0 is the ball.
inline Scene ball_above_floor(float waves, const Vec3f& move = Vec3f(0)) {
    Mesh ball = sphere_mesh(48, 24);
    for (Vec3f& p : ball.positions) p *= 1 + waves * std::sin(9 * p.x) * std::cos(7 * p.y);
    Scene scene = one_mesh(std::move(ball), {});
    scene.instances[0].translate = move;
    scene.shapes.push_back(make_shape(plane_mesh()));
    add_instance(scene, *scene.shapes[1], *scene.materials[0],
                 {.translate = move + Vec3f(0, -1, 0), .rotate_deg = Vec3f(-90, 0, 0), .scale = Vec3f(3)});
    Light<float> light;
    light.kind = LightKind::quad;
    light.position = move + Vec3f(-2, 3, 2);
    light.edge_u = Vec3f(2, 0, 0), light.edge_v = Vec3f(0, -1, 1);
    light.colour = Vec3f(2);
    scene.lights.push_back(light);
    scene.sky.background = Vec3f(0.2f, 0.3f, 0.4f);
    scene.camera.position = move + Vec3f(0, 1, 4), scene.camera.target = move;
    build(scene);
    return scene;
}

inline const std::vector<std::uint8_t> first_of_two{1, 0};

inline ProbeOptions probe_options(const Scene& scene, int size) {
    ProbeOptions options;
    options.settings = scene.settings;
    options.settings.width = options.settings.height = size;
    options.camera = scene.camera;
    return options;
}

inline std::vector<Pixel> all_pixels(int size) {
    std::vector<Pixel> pixels;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) pixels.push_back({x, y});
    return pixels;
}

/// Two independent means of the shown radiance of each pixel, as pictures are rendered: in packets of 4 x 4 pixels.
inline std::vector<ProbedPixel> whole_picture(const Scene& scene, const ProbeOptions& options, int samples_of_half,
                                              std::uint32_t seed) {
    RenderSettings settings = options.settings;
    settings.spp = 2 * samples_of_half, settings.seed = seed;
    const CameraFrame frame = camera_frame(scene);
    std::vector<ProbedPixel> out(std::size_t(settings.width) * std::size_t(settings.height));
    for (int y = 0; y < settings.height; y += block_edge)
        for (int x = 0; x < settings.width; x += block_edge) {
            const PixelBlock block = block_at(x, y, settings.width, settings.height);
            add_samples(
                scene, settings, block, {0, settings.spp, true},
                [&](const Vec2d& at, PrimaryRay& to) { set_camera_ray(frame, settings, at, to); },
                [&](int lane, int i, const Ray&, const Radiance* value, const PrimaryHit& hit) {
                    ProbedPixel& pixel = out[std::size_t(block.row(lane)) * std::size_t(settings.width) +
                                             std::size_t(block.column(lane))];
                    const float scale = std::exp2(options.exposure);
                    const auto half = std::size_t(i % 2);
                    if (value)
                        pixel.mean[half] += glm::clamp(scale * value->total(), 0.0f, 1.0f) / float(samples_of_half);
                    // Of more samples than there are bits, every second, third ... is looked at.
                    const int step = std::max(1, samples_of_half / 32), bit = i / 2 / step;
                    pixel.samples = samples_of_half / step;
                    if (i / 2 % step == 0 && hit.first.hit && hit.first.hit.mesh == 0) pixel.covered[half] |= 1u << bit;
                },
                false);
        }
    return out;
}

} // namespace bake::test
