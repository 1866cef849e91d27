// The reflection of a surface, as a sum of lobes: the data. lobe.h has their formulas.
#pragma once
#include "bake/base/vec.h"
#include <array>

namespace bake {

enum class LobeKind { lambert, phong, blinn, normalised_phong, normalised_blinn, ggx, mirror, dielectric };

struct Lobe {
    LobeKind kind = LobeKind::lambert;
    Vec3f weight{1}; ///< factor on what is reflected; ggx, mirror: reflectance at normal incidence, 0 to 1 (Schlick)
    float exponent = 32;  ///< phong, blinn and their normalised forms; at least 0
    float roughness = .5; ///< ggx: alpha = roughness^2, at least least_ggx_alpha
    float ior = 1.5;      ///< dielectric: index of refraction on the side that n points away from
    bool covered =
        false; ///< lambert under the ggx lobes: receives what those lobes do not reflect, so that energy is kept
};

/// Weighted sum of lobes.
struct Bsdf {
    static constexpr int most_lobes = 4;
    std::array<Lobe, most_lobes> lobes;
    int count = 0;
    /// Diffuse reflectance of light that enters elsewhere, and the length of its spread (see diffusion.h). It is no lobe:
    /// evaluate() and sample() leave it out.
    Vec3f translucent{0}, spread{0};
    Vec3f ambient{0};  ///< factor on ambient light
    Vec3f emission{0}; ///< emitted radiance
};

} // namespace bake
