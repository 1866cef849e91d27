#include "bake/preview/layers.h"
#include <cmath>
#include <unordered_map>

namespace bake {

std::vector<std::string> layer_channels(bool halves) {
    std::vector<std::string> all = {"R", "G", "B", "A"};
    const auto add = [&](const char* layer, const char* names) {
        for (; *names; ++names) all.push_back(std::string(layer) + "." + *names);
    };
    for (const char* layer : {"emission", "diffuse", "specular", "reflection", "albedo"}) add(layer, "RGB");
    add("N", "XYZ"), add("Ng", "XYZ");
    all.push_back("Z");
    add("P", "XYZ"), add("uv", "XY");
    for (const char* layer : {"object", "triangle", "material", "lit", "repaired", "rays", "samples"}) add(layer, "Y");
    if (halves) add("half_a", "RGB"), add("half_b", "RGB");
    return all;
}

void LayerSums::add(const Radiance& value, const FirstHit& hit) noexcept {
    emitted += Vec3d(value.emitted), diffuse += Vec3d(value.diffuse);
    specular += Vec3d(value.specular), reflected += Vec3d(value.reflected);
    albedo += Vec3d(hit.albedo), normal += Vec3d(hit.normal), facet += Vec3d(hit.facet);
    hits += bool(hit.hit), lit += hit.lit, repaired += hit.repaired;
}

void LayerSums::set_first(const FirstHit& hit, const std::vector<std::uint32_t>& materials) noexcept {
    if (!hit.hit) return;
    depth = hit.depth, position = hit.position, uv = hit.uv;
    object = hit.hit.mesh + 1, triangle = hit.hit.triangle + 1, material = materials[hit.hit.mesh];
}

std::vector<std::uint32_t> material_numbers(const Scene& scene) {
    std::unordered_map<const Material*, std::uint32_t> number_of;
    for (const auto& material : scene.materials) number_of.emplace(material.get(), std::uint32_t(number_of.size()) + 1);
    std::vector<std::uint32_t> numbers;
    for (const Instance& instance : scene.instances) numbers.push_back(number_of[instance.material]);
    return numbers;
}

float* write_layers(const LayerSums& s, const Vec3d& total, int samples, float* to) noexcept {
    const double share = samples > 0 ? 1.0 / samples : 0;
    // Extreme materials have an albedo beyond what floats hold, which is no reason to drop the radiance.
    const auto put = [&](double value) { *to++ = std::isfinite(float(value)) ? float(value) : 0; };
    const auto put3 = [&](const Vec3d& value) { put(value.x), put(value.y), put(value.z); };
    put3(total * share);
    put(s.hits * share);
    for (const Vec3d& part : {s.emitted, s.diffuse, s.specular, s.reflected, s.albedo}) put3(part * share);
    put3(unit_or_zero(s.normal));
    put3(unit_or_zero(s.facet));
    put(s.depth);
    put3(Vec3d(s.position));
    put(s.uv.x), put(s.uv.y);
    put(s.object), put(s.triangle), put(s.material);
    put(s.lit * share), put(s.repaired * share), put(s.rays * share);
    put(samples);
    return to;
}

} // namespace bake
