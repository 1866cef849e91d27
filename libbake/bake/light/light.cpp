#include "bake/light/light.h"

namespace bake {
namespace {

/// Part of a spot light's colour at an angle to its axis.
template <class T> T cone(const Light<T>& light, const Vec3<T>& l) noexcept {
    const T cosine = glm::dot(l, light.from);
    if (cosine <= light.cos_outer) return T(0);
    if (cosine >= light.cos_inner) return T(1);
    const T part = (cosine - light.cos_outer) / (light.cos_inner - light.cos_outer);
    return part * part;
}

/// The attenuation, faded out at the range by the window of KHR_lights_punctual.
template <class T> T faded(const Light<T>& light, T r) noexcept {
    const T d = attenuation(light.falloff, r);
    if (!(light.range < std::numeric_limits<T>::infinity())) return d;
    const T part = r / light.range, squared = part * part;
    return squared < T(1) ? d * (T(1) - squared * squared) : T(0);
}

/// Irradiance over pi from the whole quad, if it were all as near and as inclined as its point `at`.
template <class T> T form_factor(const Light<T>& light, const Vec3<T>& l, T r) noexcept {
    const Vec3<T> area = glm::cross(light.edge_u, light.edge_v);
    const T facing = -glm::dot(area, l);
    return facing > T(0) && r > T(0) ? facing / (T(pi) * r * r) : T(0);
}

} // namespace

template <class T> T attenuation(const Attenuation<T>& s, T r) noexcept {
    const T denominator = s.constant + r * (s.linear + r * s.quadratic);
    return denominator >= std::numeric_limits<T>::min() ? T(1) / denominator : T(0);
}

template <class T> LightSample<T> sample(const Light<T>& light, const Vec3<T>& p, const Vec2<T>& u) noexcept {
    if (light.kind == LightKind::directional) return {light.from, light.colour};
    Vec3<T> at = light.position;
    if (light.kind == LightKind::quad) at += (u.x - T(0.5)) * light.edge_u + (u.y - T(0.5)) * light.edge_v;
    const Vec3<T> l = unit_or_zero(at - p);
    const T r = glm::length(at - p);
    switch (light.kind) {
    case LightKind::quad: return {l, light.colour * form_factor(light, l, r), r};
    case LightKind::spot: return {l, light.colour * (faded(light, r) * cone(light, l)), r};
    default: return {l, light.colour * faded(light, r), r};
    }
}

template float attenuation(const Attenuation<float>&, float) noexcept;
template double attenuation(const Attenuation<double>&, double) noexcept;
template LightSample<float> sample(const Light<float>&, const Vec3f&, const Vec2f&) noexcept;
template LightSample<double> sample(const Light<double>&, const Vec3d&, const Vec2d&) noexcept;

} // namespace bake
