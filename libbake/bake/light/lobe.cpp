#include "bake/light/lobe.h"
#include "bake/light/cosine_power.h"
#include "bake/light/frame.h"
#include "bake/light/fresnel.h"
#include "bake/light/ggx.h"
#include "bake/light/lobe_view.h"

namespace bake {
namespace {

constexpr float one_over_pi = float(1 / pi);

float mean(const Vec3f& c) noexcept { return (c.x + c.y + c.z) / 3; }

/// What the lobes need of n, l and v.
struct Angles {
    float n_l, n_v;
    float v_h;    ///< also l.h
    float sin2_h; ///< squared sine of the angle from n to h
    float r_v;    ///< 1 - r.v, r being the mirror direction of l
    Angles(const Vec3f& n, const Vec3f& l, const Vec3f& v) noexcept : n_l(glm::dot(n, l)), n_v(glm::dot(n, v)) {
        // The same for l and v exchanged, to the last bit: reciprocity is not a matter of rounding.
        const Vec3f s = l + v, across = s - (n_l + n_v) * n;
        const float length2 = glm::dot(s, s), across2 = glm::dot(across, across), up = n_l - n_v;
        v_h = std::sqrt(length2) / 2;
        sin2_h = n_l + n_v > 0 && across2 < length2 ? across2 / length2 : 1;
        r_v = (across2 + up * up) / 2; // r - v = -across + (n_l - n_v) n, and |r - v|^2 = 2 - 2 r.v
    }
};

/// phong, blinn and their normalised forms, without the weight: the power of the cosine, and f times n.l.
struct Highlight {
    float power = 0, value = 0;
};
Highlight highlight(LobeKind kind, float exponent, const Angles& a) noexcept {
    switch (kind) {
    case LobeKind::phong:
    case LobeKind::normalised_phong: {
        const float power = cosine_power(a.r_v, exponent);
        const bool plain = kind == LobeKind::phong;
        return {power, power * (plain ? one_over_pi : a.n_l / float(phong_cosine_albedo(exponent)))};
    }
    case LobeKind::blinn:
    case LobeKind::normalised_blinn: {
        const float power = cosine_power(a.sin2_h, exponent / 2); // with exponent 0 it is 1 above the surface
        const bool plain = kind == LobeKind::blinn;
        return {power, power * (plain ? one_over_pi : a.n_l / float(blinn_cosine_albedo(exponent)))};
    }
    default: return {};
    }
}

void add_choices(const Bsdf& bsdf, BsdfView& view) noexcept {
    float sum = 0;
    for (int i = 0; i < view.count; ++i) {
        SeenLobe& seen = view.seen[std::size_t(i)];
        seen.choice = std::max(0.f, mean(estimated_albedo(bsdf.lobes[std::size_t(i)], seen, view)));
        seen.multiple_choice = mean(seen.multiple) * seen.at_v.loss;
        sum += seen.choice + seen.multiple_choice;
    }
    const float scale = sum > 0 ? 1 / sum : 0;
    for (SeenLobe& seen : view.seen) seen.choice *= scale, seen.multiple_choice *= scale;
}

/// A lobe, or of ggx its light of several bounces.
struct Pick {
    int lobe = -1;
    bool multiple = false;
};
Pick pick(const BsdfView& view, float choice) noexcept {
    Pick last; // rounding may leave `choice` beyond the sum
    for (int i = 0; i < view.count; ++i)
        for (const bool multiple : {false, true}) {
            const SeenLobe& seen = view.seen[std::size_t(i)];
            const float share = multiple ? seen.multiple_choice : seen.choice;
            if (!(share > 0)) continue;
            last = {i, multiple};
            if (choice < share) return last;
            choice -= share;
        }
    return last;
}

void add_ggx(const SeenLobe& seen, const GgxAlbedo& at_l, const BsdfView& view, const Vec3f& l,
             BsdfTerm& out) noexcept {
    const Angles a(view.n, l, view.raised);
    const float n_v = view.n_raised, d = ggx_distribution(seen.row.alpha, a.sin2_h);
    const float lost = at_l.loss * seen.at_v.loss / std::max(seen.average.loss, 1e-12f);
    out.value.specular += schlick(seen.f0, a.v_h) * (d * ggx_visibility(seen.row.alpha, a.n_l, n_v) * a.n_l) +
                          seen.multiple * (lost * a.n_l * one_over_pi);
    out.pdf += seen.choice * d * ggx_visible_share(seen.row.alpha, n_v) +
               seen.multiple_choice * ggx_loss_density(seen.row.alpha, a.n_l);
}

/// What depends on the cosine of l alone.
struct Lit {
    std::array<GgxAlbedo, Bsdf::most_lobes> albedo; ///< of the ggx lobes
    Vec3f cover{1};                                 ///< share of a covered lobe, besides `cover` of the view
};
Lit lit_from(const Bsdf& bsdf, const BsdfView& view, float n_l) noexcept {
    Lit out;
    for (std::size_t i = 0; i < std::size_t(view.count); ++i) {
        if (bsdf.lobes[i].kind != LobeKind::ggx) continue;
        out.albedo[i] = ggx_albedo(view.seen[i].row, n_l);
        out.cover -= view.seen[i].reflected(out.albedo[i]);
    }
    out.cover = glm::max(out.cover, Vec3f(0)) / view.cover_mean;
    return out;
}

BsdfTerm term(const Bsdf& bsdf, const BsdfView& view, const Vec3f& l) noexcept {
    BsdfTerm out;
    const Angles a(view.n, l, view.v);
    if (!(a.n_l > 0)) return out;
    const Lit lit = lit_from(bsdf, view, a.n_l);
    for (int i = 0; i < view.count; ++i) {
        const Lobe& lobe = bsdf.lobes[std::size_t(i)];
        const SeenLobe& seen = view.seen[std::size_t(i)];
        switch (lobe.kind) {
        case LobeKind::lambert:
            out.value.diffuse +=
                lobe.weight * (a.n_l * one_over_pi) * (lobe.covered ? view.cover * lit.cover : Vec3f(1));
            out.pdf += seen.choice * a.n_l * one_over_pi;
            break;
        case LobeKind::phong:
        case LobeKind::normalised_phong: {
            const Highlight h = highlight(lobe.kind, seen.exponent, a);
            out.value.specular += lobe.weight * h.value;
            out.pdf += seen.choice * cosine_power_density(seen.exponent) * h.power;
            break;
        }
        case LobeKind::blinn:
        case LobeKind::normalised_blinn: {
            const Highlight h = highlight(lobe.kind, seen.exponent, a);
            out.value.specular += lobe.weight * h.value;
            out.pdf += h.power > 0 ? seen.choice * cosine_power_density(seen.exponent) * h.power / (4 * a.v_h) : 0;
            break;
        }
        case LobeKind::ggx: add_ggx(seen, lit.albedo[std::size_t(i)], view, l, out); break;
        case LobeKind::mirror:
        case LobeKind::dielectric: break;
        }
    }
    return out;
}

Vec3f sample_cosine(const Vec2f& u) noexcept {
    const float sine = std::sqrt(u.x), turn = 2 * float(pi) * u.y;
    return {sine * std::cos(turn), sine * std::sin(turn), std::sqrt(1 - u.x)};
}

Vec3f sample_direction(const Lobe& lobe, const SeenLobe& seen, bool multiple, const BsdfView& view,
                       const Vec2f& u) noexcept {
    const Frame frame(view.n);
    if (multiple) return frame.world(sample_ggx_loss(seen.row.alpha, u));
    if (lobe.kind == LobeKind::lambert) return frame.world(sample_cosine(u));
    if (lobe.kind == LobeKind::ggx) {
        Vec3f v = frame.local(view.raised);
        v.z = std::max(v.z, least_n_v);
        return mirrored(view.raised, frame.world(sample_visible_normal(seen.row.alpha, v, u)));
    }
    const Vec3f about = sample_cosine_power(seen.exponent, u);
    if (lobe.kind == LobeKind::phong || lobe.kind == LobeKind::normalised_phong)
        return Frame(unit_or_zero(mirrored(view.v, view.n))).world(about);
    return mirrored(view.v, frame.world(about));
}

BsdfSample sample_mirror(const Lobe& lobe, const BsdfView& view, float probability) noexcept {
    const Vec3f f = schlick(glm::clamp(lobe.weight, Vec3f(0), Vec3f(1)), view.n_raised);
    return {unit_or_zero(mirrored(view.raised, view.n)), f / probability, probability, true, true};
}

BsdfSample sample_dielectric(const Lobe& lobe, const BsdfView& view, float probability, float u) noexcept {
    const float n_v = std::clamp(glm::dot(view.n, view.v), -1.f, 1.f), ior = std::clamp(lobe.ior, 1e-3f, 1e3f);
    const Vec3f n = n_v < 0 ? -view.n : view.n;
    const float cosine = std::abs(n_v), eta = n_v < 0 ? ior : 1 / ior;
    float cos_t = 0;
    const float f = fresnel(cosine, eta, cos_t);
    const bool reflects = u < f;
    const Vec3f l = reflects ? mirrored(view.v, n) : (eta * cosine - cos_t) * n - eta * view.v;
    // Reflection is chosen with the probability f, which cancels.
    return {unit_or_zero(l), lobe.weight / probability, probability * (reflects ? f : 1 - f), true, true};
}

} // namespace

namespace {

/// The commonest material, for which a view of all lobes takes longer than the rest.
bool is_lambert(const Bsdf& bsdf) noexcept {
    return bsdf.count == 1 && bsdf.lobes[0].kind == LobeKind::lambert && !bsdf.lobes[0].covered;
}
BsdfTerm lambert(const Bsdf& bsdf, float n_l) noexcept {
    const float cosine = n_l * one_over_pi;
    return {{bsdf.lobes[0].weight * cosine, Vec3f(0)}, mean(bsdf.lobes[0].weight) > 0 ? cosine : 0};
}

} // namespace

namespace {

bool has_ggx(const Bsdf& bsdf) noexcept {
    for (int i = 0; i < bsdf.count; ++i)
        if (bsdf.lobes[std::size_t(i)].kind == LobeKind::ggx) return true;
    return false;
}

/// evaluate() where no lobe depends on another one, or on more of the viewer than v.
BsdfValue plain_value(const Bsdf& bsdf, const Angles& a) noexcept {
    BsdfValue out;
    for (int i = 0; i < bsdf.count; ++i) {
        const Lobe& lobe = bsdf.lobes[std::size_t(i)];
        if (lobe.kind == LobeKind::lambert) out.diffuse += lobe.weight * (a.n_l * one_over_pi);
        else out.specular += lobe.weight * highlight(lobe.kind, std::max(0.f, lobe.exponent), a).value;
    }
    return out;
}

} // namespace

BsdfValue evaluate(const Bsdf& bsdf, const Vec3f& n, const Vec3f& l, const Vec3f& v) noexcept {
    const float n_l = glm::dot(n, l);
    if (!(n_l > 0)) return {};
    if (is_lambert(bsdf)) return lambert(bsdf, n_l).value;
    if (!has_ggx(bsdf)) return plain_value(bsdf, {n, l, v});
    return term(bsdf, view_of(bsdf, n, v), l).value;
}

BsdfTerm evaluate_with_pdf(const Bsdf& bsdf, const Vec3f& n, const Vec3f& l, const Vec3f& v) noexcept {
    const float n_l = glm::dot(n, l);
    if (!(n_l > 0)) return {};
    if (is_lambert(bsdf)) return lambert(bsdf, n_l);
    BsdfView view = view_of(bsdf, n, v);
    add_choices(bsdf, view);
    return term(bsdf, view, l);
}

float pdf(const Bsdf& bsdf, const Vec3f& n, const Vec3f& l, const Vec3f& v) noexcept {
    return evaluate_with_pdf(bsdf, n, l, v).pdf;
}

BsdfSample sample(const Bsdf& bsdf, const Vec3f& n, const Vec3f& v, float choice, const Vec2f& u) noexcept {
    if (is_lambert(bsdf)) {
        const Vec3f l = unit_or_zero(Frame(n).world(sample_cosine(u)));
        const BsdfTerm all = lambert(bsdf, std::max(0.f, glm::dot(n, l)));
        if (!(all.pdf > 1e-30f)) return {};
        return {l, bsdf.lobes[0].weight, all.pdf, false, false, all.value};
    }
    BsdfView view = view_of(bsdf, n, v);
    add_choices(bsdf, view);
    const auto [picked, multiple] = pick(view, choice);
    if (picked < 0) return {};
    const Lobe& lobe = bsdf.lobes[std::size_t(picked)];
    const SeenLobe& seen = view.seen[std::size_t(picked)];
    if (lobe.kind == LobeKind::mirror) return sample_mirror(lobe, view, seen.choice);
    if (lobe.kind == LobeKind::dielectric) return sample_dielectric(lobe, view, seen.choice, u.x);
    const Vec3f l = unit_or_zero(sample_direction(lobe, seen, multiple, view, u));
    const BsdfTerm all = term(bsdf, view, l);
    if (!(all.pdf > 1e-30f)) return {};
    return {
        l,        (all.value.diffuse + all.value.specular) / all.pdf, all.pdf, false, lobe.kind != LobeKind::lambert,
        all.value};
}

Vec3f cover(const Bsdf& bsdf, const Vec3f& n, const Vec3f& v) noexcept {
    bool covered = false;
    for (int i = 0; i < bsdf.count; ++i) covered |= bsdf.lobes[std::size_t(i)].covered;
    return covered ? view_of(bsdf, n, v).cover : Vec3f(1);
}

Bsdf metallic_roughness(const Vec3f& base, float metallic, float roughness) noexcept {
    Bsdf out;
    out.count = 2;
    out.lobes[0].kind = LobeKind::ggx;
    out.lobes[0].weight = glm::mix(Vec3f(0.04f), base, metallic);
    out.lobes[0].roughness = roughness;
    out.lobes[1].weight = base * (1 - metallic);
    out.lobes[1].covered = true;
    return out;
}

} // namespace bake
