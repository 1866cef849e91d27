#include "bake/light/split_sum.h"
#include "bake/light/lobe_view.h"

namespace bake {
namespace {

bool is_phong(LobeKind kind) noexcept { return kind == LobeKind::phong || kind == LobeKind::normalised_phong; }

/// Roughness of a ggx lobe like (n.h)^exponent: alpha^2 = 2 / (exponent + 2) gives D the same value at its peak (Walter et
/// al. 2007). Near its peak (r.v)^n is (n.h)^4n.
float roughness_of(const Lobe& lobe, float exponent) noexcept {
    const float blinn = is_phong(lobe.kind) ? 4 * exponent : exponent;
    return std::min(1.f, std::sqrt(std::sqrt(2 / (blinn + 2))));
}

/// The mean direction of a lobe of ggx, which lies between the mirror direction and the normal. The share of the normal is a
/// fit to integrals of the lobe at 45 degrees, within .05; at grazing angles it is up to .2 larger.
Vec3f lobe_axis(const BsdfView& view, float roughness) noexcept {
    const float alpha = roughness * roughness, share = alpha * roughness * (1.5f - 0.5f * alpha);
    return unit_or_zero(glm::mix(mirrored(view.raised, view.n), view.n, share));
}

} // namespace

SplitSum split_sum(const Bsdf& bsdf, const Vec3f& n, const Vec3f& v) noexcept {
    SplitSum out;
    const BsdfView view = view_of(bsdf, n, v);
    for (int i = 0; i < view.count; ++i) {
        const Lobe& lobe = bsdf.lobes[std::size_t(i)];
        const SeenLobe& seen = view.seen[std::size_t(i)];
        if (lobe.kind == LobeKind::mirror || lobe.kind == LobeKind::dielectric) continue;
        const Vec3f albedo = estimated_albedo(lobe, seen, view);
        if (lobe.kind == LobeKind::lambert) {
            out.diffuse += albedo;
            continue;
        }
        const bool ggx = lobe.kind == LobeKind::ggx;
        if (ggx) out.scattered += seen.multiple * seen.at_v.loss;
        const float roughness = ggx ? std::clamp(lobe.roughness, 0.f, 1.f) : roughness_of(lobe, seen.exponent);
        out.gloss[std::size_t(out.count++)] = {albedo, lobe_axis(view, ggx ? roughness : 0), roughness};
    }
    return out;
}

} // namespace bake
