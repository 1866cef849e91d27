// A Bsdf in the light of a filtered sky, as real-time engines shade: the integral of reflectance times light is split into
// the reflectance of even light, and the mean light under the lobe.
//
// Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013 course. The first factor is the directional albedo, exact for lambert
// and ggx; the second is looked up in the sky convolved with a lobe that is seen from its own axis.
#pragma once
#include "bake/light/bsdf.h"

namespace bake {

struct SplitSum {
    Vec3f diffuse{0};   ///< of irradiance over pi
    Vec3f scattered{0}; ///< the same, by ggx: its light of several bounces
    struct Gloss {
        Vec3f factor{0};     ///< on the sky filtered with a ggx lobe
        Vec3f axis{0};       ///< unit: where that lobe points
        float roughness = 0; ///< square root of its alpha
    };
    std::array<Gloss, Bsdf::most_lobes> gloss;
    int count = 0; ///< of gloss
};

/// Lobes of Phong and Blinn become ggx lobes of about the same width, with their albedo at normal incidence, which is their
/// largest. Mirror and dielectric give 0. Unit vectors as for evaluate().
SplitSum split_sum(const Bsdf& bsdf, const Vec3f& n, const Vec3f& v) noexcept;

} // namespace bake
