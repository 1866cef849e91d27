#include "bake/light/lobe_view.h"
#include "bake/light/cosine_power.h"
#include "bake/light/fresnel.h"

namespace bake {
namespace {

constexpr float least_cover = 1e-4f; ///< mean light left to a covered lobe, below which it gets none

void see_ggx(const Lobe& lobe, BsdfView& view, SeenLobe& seen) noexcept {
    const float roughness = std::clamp(lobe.roughness, 0.f, 1.f);
    seen.row = ggx_row(roughness * roughness);
    seen.f0 = glm::clamp(lobe.weight, Vec3f(0), Vec3f(1));
    seen.at_v = ggx_albedo(seen.row, view.n_raised);
    seen.average = ggx_mean_albedo(seen.row);
    // Hill, A Multi-Faceted Exploration, 2018: the geometric series of what is lost and reflected again.
    const Vec3f f_mean = seen.f0 + (Vec3f(1) - seen.f0) / 21.f;
    seen.multiple = f_mean * f_mean * (1 - seen.average.loss) / (Vec3f(1) - f_mean * seen.average.loss);
    view.cover -= seen.reflected(seen.at_v);
    view.cover_mean -= seen.reflected(seen.average);
}

} // namespace

BsdfView view_of(const Bsdf& bsdf, const Vec3f& n, const Vec3f& v) noexcept {
    BsdfView view{n, v, v, glm::dot(n, v), {}, std::clamp(bsdf.count, 0, Bsdf::most_lobes)};
    if (!(view.n_raised >= least_n_v)) {
        view.raised = unit_or_zero(v + (least_n_v - view.n_raised) * n);
        view.n_raised = std::clamp(glm::dot(n, view.raised), least_n_v, 1.f);
    }
    for (int i = 0; i < view.count; ++i) {
        const Lobe& lobe = bsdf.lobes[std::size_t(i)];
        SeenLobe& seen = view.seen[std::size_t(i)];
        seen.exponent = std::max(0.f, lobe.exponent);
        if (lobe.kind == LobeKind::ggx) see_ggx(lobe, view, seen);
    }
    view.cover = glm::max(view.cover, Vec3f(0));
    for (int c = 0; c < 3; ++c)
        if (!(view.cover_mean[c] > least_cover)) view.cover_mean[c] = 1, view.cover[c] = 0;
    return view;
}

Vec3f estimated_albedo(const Lobe& lobe, const SeenLobe& seen, const BsdfView& view) noexcept {
    switch (lobe.kind) {
    case LobeKind::lambert: return lobe.covered ? lobe.weight * view.cover : lobe.weight;
    case LobeKind::phong: return lobe.weight * float(phong_albedo(seen.exponent) / pi);
    case LobeKind::blinn: return lobe.weight * float(blinn_albedo(seen.exponent) / pi);
    case LobeKind::ggx: return seen.reflected(seen.at_v) - seen.multiple * seen.at_v.loss;
    case LobeKind::mirror: return schlick(glm::clamp(lobe.weight, Vec3f(0), Vec3f(1)), view.n_raised);
    case LobeKind::normalised_phong:
    case LobeKind::normalised_blinn:
    case LobeKind::dielectric: break;
    }
    return lobe.weight;
}

} // namespace bake
