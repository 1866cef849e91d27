// The GGX microfacet lobe with height-correlated Smith masking, in terms of cosines and of the local frame with z = n.
//
//   f = F D G2 / (4 n.l n.v),  D = alpha^2 / (pi ((n.h)^2 (alpha^2 - 1) + 1)^2)
//
// Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007. Heitz, Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 2014. Visible normals are sampled by the spherical caps of
// Dupuy and Benyoub, Sampling Visible GGX Normals with Spherical Caps, HPG 2023.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// D of the squared sine of the angle from n to h.
float ggx_distribution(float alpha, float sin2_h) noexcept;
/// G2 / (4 n.l n.v), for n.l and n.v above 0.
float ggx_visibility(float alpha, float n_l, float n_v) noexcept;
/// D times this is the density of l = reflect(v, h) for a visible normal h: G1 / (4 n.v).
float ggx_visible_share(float alpha, float n_v) noexcept;
/// A visible normal of the view direction `v` (v.z > 0), from u in [0, 1).
Vec3f sample_visible_normal(float alpha, const Vec3f& v, const Vec2f& u) noexcept;

} // namespace bake
