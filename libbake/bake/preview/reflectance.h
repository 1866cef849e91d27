// What a material states of its reflection, and the lobes that this means.
#pragma once
#include "bake/light/lobe.h"

namespace bake {

/// The lecture's m_amb, m_diff, m_spec, m_shi and m_emi, and the model of the highlight. Colours are linear RGB.
struct Reflectance {
    enum class Model {
        blinn,            ///< diffuse + specular (n.h)^shininess
        phong,            ///< diffuse + specular (r.v)^shininess
        normalised_blinn, ///< the same with factors that conserve energy
        normalised_phong,
        ggx,        ///< metallic-roughness of glTF: diffuse is the base colour
        dielectric, ///< smooth glass
    };
    Model model = Model::blinn;
    Vec3f ambient{0.8f}, diffuse{0.8f}, specular{0}, emission{0};
    float shininess = 32;
    float metallic = 0, roughness = 0.5f; ///< ggx
    float ior = 1.5f;                     ///< dielectric: index of refraction
    /// Mean free path of light below the surface, in world units: diffuse reflection spreads. 0: it does not.
    Vec3f subsurface{0};
    float translucency = 1; ///< share of the diffuse reflection that spreads
};

/// The lobe of the highlight; none of a dielectric.
LobeKind highlight(Reflectance::Model model) noexcept;

/// `tint` multiplies ambient and diffuse.
Bsdf make_bsdf(const Reflectance& reflectance, const Vec3f& tint = Vec3f(1)) noexcept;

/// The diffuse reflectance.
Vec3f albedo(const Bsdf& bsdf) noexcept;

} // namespace bake
