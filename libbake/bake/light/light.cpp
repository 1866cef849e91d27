#include "bake/light/light.h"
#include <limits>

namespace bake {

template <class T> T attenuation(const Attenuation<T>& s, T r) noexcept {
    const T denominator = s.constant + r * (s.linear + r * s.quadratic);
    return denominator >= std::numeric_limits<T>::min() ? T(1) / denominator : T(0);
}

template <class T> LightSample<T> sample(const Light<T>& light, const Vec3<T>& p) noexcept {
    if (light.kind == LightKind::directional) return {light.from, light.colour};
    const Vec3<T> to_light = light.position - p;
    return {unit_or_zero(to_light), light.colour * attenuation(light.falloff, glm::length(to_light))};
}

template float attenuation(const Attenuation<float>&, float) noexcept;
template double attenuation(const Attenuation<double>&, double) noexcept;
template LightSample<float> sample(const Light<float>&, const Vec3f&) noexcept;
template LightSample<double> sample(const Light<double>&, const Vec3d&) noexcept;

} // namespace bake
