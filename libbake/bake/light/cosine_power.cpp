#include "bake/light/cosine_power.h"

namespace bake {

float cosine_power(float one_minus_cos, float exponent) noexcept {
    return one_minus_cos < 1 ? std::exp(exponent * std::log1p(-one_minus_cos)) : 0.f;
}

Vec3f sample_cosine_power(float exponent, const Vec2f& u) noexcept {
    // cos = (1 - u)^(1 / (n + 1)), and sin^2 = 1 - cos^2 without cancellation.
    const float log_cos = std::log1p(-u.x) / (exponent + 1);
    const float sine = std::sqrt(-std::expm1(2 * log_cos)), turn = 2 * float(pi) * u.y;
    return {sine * std::cos(turn), sine * std::sin(turn), std::exp(log_cos)};
}

float cosine_power_density(float exponent) noexcept { return (exponent + 1) / (2 * float(pi)); }

double phong_albedo(double exponent) noexcept { return 2 * pi / (exponent + 1); }
double phong_cosine_albedo(double exponent) noexcept { return 2 * pi / (exponent + 2); }
double blinn_albedo(double exponent) noexcept { return 8 * pi * (1 - std::exp2(-(exponent + 2) / 2)) / (exponent + 2); }
double blinn_cosine_albedo(double exponent) noexcept {
    return 8 * pi * (exponent + std::exp2(-exponent / 2)) / ((exponent + 2) * (exponent + 4));
}

} // namespace bake
