// What the layers of a picture hold: means over the samples of a pixel, and what its first sample hits.
#pragma once
#include "bake/preview/tracer.h"
#include <string>
#include <vector>

namespace bake {

/// The channels of render_layers(), with the names of OpenEXR files that compositing programs expect:
///   R G B A              mean radiance; share of the samples that hit a mesh
///   emission diffuse specular reflection   the parts of R, G, B, as in Radiance
///   albedo N Ng          means of the diffuse reflectance and of the shading and facet normals, in world space
///   Z P uv               of the first sample: distance from the camera, position, uv
///   object triangle material   of the first sample: numbers from 1 (0: no mesh)
///   lit repaired         share of lights that are not shadowed, of samples whose relief is in trouble
///   rays samples         rays per sample; samples
/// and with `halves`
///   half_a half_b        mean radiance of two halves of the samples that are independent of each other
std::vector<std::string> layer_channels(bool halves = false);

/// Sums over the samples of a pixel, beside its radiance.
struct LayerSums {
    Vec3d emitted{0}, diffuse{0}, specular{0}, reflected{0}, albedo{0}, normal{0}, facet{0};
    double hits = 0, lit = 0, repaired = 0, rays = 0;
    // Of the first sample.
    float depth = 0;
    Vec3f position{0};
    Vec2f uv{0};
    std::uint32_t object = 0, triangle = 0, material = 0;

    void add(const Radiance& value, const FirstHit& hit) noexcept;
    /// `materials`: see material_numbers().
    void set_first(const FirstHit& hit, const std::vector<std::uint32_t>& materials) noexcept;
};

/// For each instance of a scene the number, from 1, of its material.
std::vector<std::uint32_t> material_numbers(const Scene& scene);

/// Writes the values of a pixel in the order of layer_channels(), without halves. `total`: the sum of the radiance.
/// Returns the end of what was written.
float* write_layers(const LayerSums& sums, const Vec3d& total, int samples, float* to) noexcept;

} // namespace bake
