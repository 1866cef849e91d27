#include "bake/verdict/plan/shading_bound.h"
#include "bake/light/cosine_power.h"
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace bake {
namespace {

double power(double angle, double exponent) noexcept {
    return angle < pi / 2 ? std::pow(std::cos(std::max(0.0, angle)), exponent) : 0;
}

/// The steepest slope of cos^e between two angles: e cos^(e - 1) sin has its only maximum at tan^2 = 1 / (e - 1).
double steepest_power(double low, double high, double exponent) noexcept {
    const double peak = exponent > 1 ? std::atan(1 / std::sqrt(exponent - 1)) : pi / 2;
    const double at = std::clamp(peak, std::max(0.0, low), std::clamp(high, 0.0, pi / 2));
    return exponent * std::pow(std::cos(at), exponent - 1) * std::sin(at);
}

double angle_of(const Vec3d& a, const Vec3d& b) noexcept {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

bool is_black(const Vec3f& c) noexcept { return c == Vec3f(0); }

bool has_bound(const Scene& scene, const Material& m) noexcept {
    const Reflectance& r = m.reflectance;
    if (r.model == Reflectance::Model::ggx || r.model == Reflectance::Model::dielectric) return false;
    if (has_textures(m) || has_relief(m) || m.maps || !is_black(m.reflect) || !is_black(r.subsurface)) return false;
    if (!is_black(r.specular) && !(r.shininess >= 1)) return false;
    if (scene.settings.sky_light == SkyLighting::irradiance && !scene.sky.cube.empty()) return false;
    return scene.settings.sky_light == SkyLighting::off || scene.sky_light.is_black();
}

Vec3d size_of(const Vec3f& c) noexcept { return glm::abs(Vec3d(c)); }

} // namespace

std::optional<ShadingBound> ShadingBound::of(const Scene& scene, const Material& material, const Vec3d& f,
                                             const ViewCone& view, float exposure) {
    if (!has_bound(scene, material)) return {};
    const Reflectance& r = material.reflectance;
    const double gain = std::exp2(double(exposure));
    using Model = Reflectance::Model;
    const bool phong = r.model == Model::phong || r.model == Model::normalised_phong;
    ShadingBound out;
    out.shadows_ = scene.settings.shadows;
    out.exponent_ = r.shininess, out.turns_ = phong ? 2 : 1;
    out.cosine_ = r.model == Model::normalised_phong || r.model == Model::normalised_blinn;
    const double scale = !out.cosine_ ? 1
                         : phong      ? pi / phong_cosine_albedo(out.exponent_)
                                      : pi / blinn_cosine_albedo(out.exponent_);
    out.constant_ = gain * (size_of(r.emission) + size_of(r.ambient) * size_of(scene.ambient));
    for (const Light<float>& light : scene.lights) {
        if (is_black(light.colour)) continue;
        if (light.kind != LightKind::directional) return {};
        const Vec3d l = unit_or_zero(Vec3d(light.from)), colour = gain * size_of(light.colour);
        Shone shone;
        shone.sine = std::clamp(glm::dot(l, f), -1.0, 1.0);
        shone.cosine = std::sqrt(1 - shone.sine * shone.sine);
        shone.diffuse = colour * size_of(light.diffuse) * size_of(r.diffuse);
        shone.specular = scale * colour * size_of(light.specular) * size_of(r.specular);
        double spread = view.angle, middle = 0;
        if (phong) middle = angle_of(2 * shone.sine * f - l, view.axis);
        // The direction h turns by at most as much as the viewer while |l + v| is at least 1.
        else if (angle_of(l, view.axis) + view.angle < 2 * pi / 3) middle = angle_of(f, unit_or_zero(l + view.axis));
        else spread = pi;
        shone.low = middle - spread, shone.high = middle + spread;
        out.lights_.push_back(shone);
    }
    return out;
}

double ShadingBound::specular_change(const Shone& light, double tilt) const noexcept {
    const double turn = turns_ * tilt, low = light.low - turn, high = light.high + turn;
    const double most = power(low, exponent_);
    const double change = std::min(most, turn * steepest_power(low, high, exponent_));
    if (!cosine_) return change;
    // A product of n.l and the power; n.l changes by at most the tilt.
    const double most_cosine = std::min(1.0, std::max(0.0, light.sine) + tilt);
    return std::min(most_cosine * most, tilt * most + most_cosine * change);
}

Vec3d ShadingBound::change_of(const Shone& light, double g, double steepest) const noexcept {
    const double tilt = std::atan(g), sine = std::max(0.0, light.sine);
    // Light that no normal of this tilt sees.
    if (light.sine <= -std::sin(tilt)) return Vec3d(0);
    double diffuse = g * light.cosine + sine * (1 - 1 / std::sqrt(1 + g * g));
    diffuse = std::min(diffuse, std::min(1.0, sine + tilt));
    double specular = specular_change(light, tilt);
    const bool may_be_hidden = shadows_ && light.sine < 2 * steepest * light.cosine;
    const double all = power(light.low - turns_ * tilt, exponent_) * (cosine_ ? std::min(1.0, sine + tilt) : 1);
    if (may_be_hidden) diffuse = std::max(diffuse, sine);
    if (may_be_hidden || std::abs(light.sine) <= std::sin(tilt)) specular = std::max(specular, all);
    return diffuse * light.diffuse + specular * light.specular;
}

Vec3d ShadingBound::change(double g, double steepest) const noexcept {
    Vec3d sum(0);
    for (const Shone& light : lights_) sum += change_of(light, g, steepest);
    return glm::min(sum, Vec3d(1));
}

Vec3d ShadingBound::most() const noexcept {
    Vec3d sum = constant_;
    for (const Shone& light : lights_) sum += light.diffuse + light.specular;
    return glm::min(sum, Vec3d(1));
}

} // namespace bake
