#include "bake/light/diffusion.h"

namespace bake {

float diffusion_length(float reflectance, float mean_free_path) noexcept {
    const float a = std::clamp(reflectance, 0.f, 1.f), beyond = a - 0.8f;
    return mean_free_path / (1.9f - a + 3.5f * beyond * beyond);
}

float diffusion_profile(float d, float r) noexcept {
    return (std::exp(-r / d) + std::exp(-r / (3 * d))) / (8 * float(pi) * d * r);
}

float diffusion_within(float d, float r) noexcept { return -(std::expm1(-r / d) + 3 * std::expm1(-r / (3 * d))) / 4; }

float sample_diffusion(float d, float u) noexcept {
    const bool narrow = u < 0.25f;
    const float part = narrow ? 4 * u : (u - 0.25f) / 0.75f;
    return -(narrow ? d : 3 * d) * std::log1p(-std::min(part, 1 - 0x1p-24f));
}

} // namespace bake
