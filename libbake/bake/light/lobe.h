// Reflection of a surface as a sum of lobes, to evaluate, to sample, and with the density of the samples.
//
//   lambert           f = weight / pi
//   phong             f cos = weight (r.v)^n / pi   as Phong wrote it: no further cosine
//   blinn             f cos = weight (n.h)^n / pi   as Blinn wrote it
//   normalised_phong  f = weight (n + 2) / (2 pi) (r.v)^n                             Lewis 1994
//   normalised_blinn  f = weight (n + 2) (n + 4) / (8 pi (n + 2^(-n/2))) (n.h)^n      see cosine_power.h
//   ggx               f = F D G2 / (4 n.l n.v) + the light of several bounces         see ggx.h
//   mirror            F in the mirror direction
//   dielectric        Fresnel's reflection and refraction at a smooth border
//
// The 1 / pi of phong and blinn: a light of colour c gives the irradiance pi c at normal incidence, so that weight (n.h)^n c
// is reflected. They gain energy at low exponents, and phong is not reciprocal; the other lobes conserve energy and are
// reciprocal. Lewis, Making Shaders More Physically Plausible, CGF 1994. Light of several bounces between microfacets is
// added as by Kulla and Conty, Revisiting Physically Based Shading at Imageworks, SIGGRAPH course 2017; lambert under ggx
// as by Kelemen and Szirmay-Kalos, A Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001.
#pragma once
#include "bake/light/bsdf.h"

namespace bake {

// All vectors are unit vectors; n and v, l point away from the surface. Light from below the surface (n.l <= 0) is not
// reflected. A viewer below the surface (relief can tilt n away from the viewer) sees ggx and mirror as from the horizon
// of the surface, and the other lobes by their formulas. A dielectric is seen from inside then.

/// f times n.l.
struct BsdfValue {
    Vec3f diffuse{0};  ///< lambert
    Vec3f specular{0}; ///< the other lobes; mirror and dielectric give 0
};
BsdfValue evaluate(const Bsdf& bsdf, const Vec3f& n, const Vec3f& l, const Vec3f& v) noexcept;

struct BsdfSample {
    Vec3f l{0};
    Vec3f factor{
        0}; ///< f |cos| / pdf of the sum of all lobes that are not singular, or of the singular lobe; 0: absorbed
    float pdf = 0;         ///< per solid angle; probability if singular
    bool singular = false; ///< from mirror or dielectric: l is the only direction
    bool specular = false; ///< from another lobe than lambert
    BsdfValue value;       ///< of evaluate() for l; 0 if singular
};
/// A direction of light for the viewer `v`. `choice` in [0, 1) picks a lobe in proportion to its estimated albedo, u in
/// [0, 1) the direction. Across a dielectric border paths carry L / n^2, which refraction does not change (L is radiance, n the
/// index of refraction). After a path has entered and left a glass body, the factor is the one of L itself.
BsdfSample sample(const Bsdf& bsdf, const Vec3f& n, const Vec3f& v, float choice, const Vec2f& u) noexcept;

/// Density of the directions of sample() per solid angle, without the singular lobes. Its integral is at most 1, as some
/// samples are absorbed.
float pdf(const Bsdf& bsdf, const Vec3f& n, const Vec3f& l, const Vec3f& v) noexcept;

/// Both at once.
struct BsdfTerm {
    BsdfValue value;
    float pdf = 0;
};
BsdfTerm evaluate_with_pdf(const Bsdf& bsdf, const Vec3f& n, const Vec3f& l, const Vec3f& v) noexcept;

/// Transmittance of the ggx lobes towards the viewer, for light that the lobes under them reflect; 1 without such lobes.
Vec3f cover(const Bsdf& bsdf, const Vec3f& n, const Vec3f& v) noexcept;

/// The material of glTF 2.0, appendix B: ggx with the reflectance mix(0.04, base, metallic) over lambert of
/// base (1 - metallic). Lambert's share is what ggx does not reflect on the way in and out, instead of 1 - F(v.h).
Bsdf metallic_roughness(const Vec3f& base, float metallic, float roughness) noexcept;

} // namespace bake
