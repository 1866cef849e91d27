#include "bake/preview/widen.h"
#include <cmath>

namespace bake {
namespace {

/// The exponent of (n.h)^exponent; (r.v)^n is as wide as (n.h)^(4 n), hence `per` is 4.
float widened_exponent(float exponent, float per, double variance) noexcept {
    const double alpha2 = 2 / (double(per) * exponent + 2) + 2 * variance;
    return float(std::max(0.0, 2 / alpha2 - 2) / per);
}

} // namespace

Lobe widened(const Lobe& lobe, float variance) noexcept {
    Lobe out = lobe;
    switch (lobe.kind) {
    case LobeKind::lambert: out.weight /= std::sqrt(1 + 2 * variance); break;
    case LobeKind::blinn:
        out.exponent = widened_exponent(lobe.exponent, 1, variance);
        out.weight *= (out.exponent + 2) / (lobe.exponent + 2);
        break;
    case LobeKind::phong:
        out.exponent = widened_exponent(lobe.exponent, 4, variance);
        out.weight *= (out.exponent + 1) / (lobe.exponent + 1);
        break;
    // The normalised models keep their flux by themselves.
    case LobeKind::normalised_blinn: out.exponent = widened_exponent(lobe.exponent, 1, variance); break;
    case LobeKind::normalised_phong: out.exponent = widened_exponent(lobe.exponent, 4, variance); break;
    case LobeKind::ggx: {
        const double alpha = double(lobe.roughness) * lobe.roughness; // alpha is the width of a slope here as well
        out.roughness = float(std::min(1.0, std::pow(alpha * alpha + 2 * double(variance), 0.25)));
        break;
    }
    case LobeKind::mirror:
    case LobeKind::dielectric: break;
    }
    return out;
}

void widen(Bsdf& bsdf, float variance) noexcept {
    if (!(variance > 0)) return;
    for (int i = 0; i < bsdf.count; ++i) bsdf.lobes[i] = widened(bsdf.lobes[i], variance);
}

Vec3f varied_normal(const Vec3f& n, float variance, const Vec2f& u) noexcept {
    // Box and Muller, A Note on the Generation of Random Normal Deviates, 1958.
    const float radius = std::sqrt(-2 * variance * std::log(std::max(1 - u.x, 1e-7f)));
    const float angle = 2 * float(pi) * u.y;
    const Vec3f a = unit_or_zero(glm::cross(n, std::abs(n.x) < 0.5f ? Vec3f(1, 0, 0) : Vec3f(0, 1, 0)));
    const Vec3f varied = unit_or_zero(n + radius * (std::cos(angle) * a + std::sin(angle) * glm::cross(n, a)));
    return varied != Vec3f(0) ? varied : n;
}

} // namespace bake
