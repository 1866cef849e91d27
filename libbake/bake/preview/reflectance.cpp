#include "bake/preview/reflectance.h"
#include "bake/light/diffusion.h"

namespace bake {

LobeKind highlight(Reflectance::Model model) noexcept {
    switch (model) {
    case Reflectance::Model::phong: return LobeKind::phong;
    case Reflectance::Model::normalised_blinn: return LobeKind::normalised_blinn;
    case Reflectance::Model::normalised_phong: return LobeKind::normalised_phong;
    case Reflectance::Model::ggx: return LobeKind::ggx;
    case Reflectance::Model::dielectric: return LobeKind::dielectric;
    case Reflectance::Model::blinn: break;
    }
    return LobeKind::blinn;
}

namespace {

void add(Bsdf& bsdf, const Lobe& lobe) noexcept {
    if (lobe.weight != Vec3f(0)) bsdf.lobes[bsdf.count++] = lobe;
}

/// Takes the share of the diffuse reflection that spreads out of the lobe.
void spread(const Reflectance& r, Bsdf& bsdf) noexcept {
    for (int i = 0; i < bsdf.count; ++i) {
        Lobe& lobe = bsdf.lobes[std::size_t(i)];
        if (lobe.kind != LobeKind::lambert) continue;
        for (int c = 0; c < 3; ++c) {
            if (!(r.subsurface[c] > 0)) continue;
            bsdf.spread[c] = diffusion_length(lobe.weight[c], r.subsurface[c]);
            bsdf.translucent[c] = r.translucency * lobe.weight[c];
            lobe.weight[c] -= bsdf.translucent[c];
        }
    }
}

} // namespace

Bsdf make_bsdf(const Reflectance& r, const Vec3f& tint) noexcept {
    Bsdf bsdf;
    switch (r.model) {
    case Reflectance::Model::ggx: bsdf = metallic_roughness(r.diffuse * tint, r.metallic, r.roughness); break;
    case Reflectance::Model::dielectric: add(bsdf, {.kind = LobeKind::dielectric, .weight = tint, .ior = r.ior}); break;
    default:
        add(bsdf, {.kind = LobeKind::lambert, .weight = r.diffuse * tint});
        add(bsdf, {.kind = highlight(r.model), .weight = r.specular, .exponent = r.shininess});
    }
    if (r.subsurface != Vec3f(0) && r.translucency > 0) spread(r, bsdf);
    bsdf.ambient = r.ambient * tint, bsdf.emission = r.emission;
    return bsdf;
}

Vec3f albedo(const Bsdf& bsdf) noexcept {
    Vec3f sum = bsdf.translucent;
    for (int i = 0; i < bsdf.count; ++i)
        if (bsdf.lobes[i].kind == LobeKind::lambert) sum += bsdf.lobes[i].weight;
    return sum;
}

} // namespace bake
