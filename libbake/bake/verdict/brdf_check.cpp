#include "bake/verdict/brdf_check.h"
#include "bake/base/text.h"
#include "bake/light/cosine_power.h"
#include "bake/verdict/finding_text.h"

namespace bake {
namespace {

const Vec3f up(0, 0, 1);
constexpr int samples = 1 << 13; // of a directional albedo

Vec3f direction(double theta_deg, double phi_deg) {
    const double t = theta_deg * pi / 180, p = phi_deg * pi / 180;
    return Vec3f(Vec3d(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)));
}

bool as_its_author_wrote(LobeKind kind) { return kind == LobeKind::phong || kind == LobeKind::blinn; }

/// Van der Corput's sequence: the digits of i mirrored at the point. Below 1 as a float too, as i < samples has few digits.
float mirrored_digits(int i, int base) {
    double out = 0, digit = 1;
    for (; i > 0; i /= base) out += (digit /= base) * (i % base);
    return float(out);
}

/// Mean factor of samples at the points of Hammersley's set.
double mean_factor(const Bsdf& bsdf, const Vec3f& v) {
    double sum = 0;
    for (int i = 0; i < samples && bsdf.count > 0; ++i) {
        const float choice = (float(i) + 0.5f) / float(samples);
        sum += double(sample(bsdf, up, v, choice, {mirrored_digits(i, 2), mirrored_digits(i, 3)}).factor.x);
    }
    return sum / samples;
}

BrdfEnergy energy(const Bsdf& bsdf) {
    Bsdf gain, loss; // sample() takes weights that are not negative
    for (int i = 0; i < bsdf.count; ++i) {
        Lobe lobe = bsdf.lobes[std::size_t(i)];
        Bsdf& side = lobe.weight.x < 0 ? loss : gain;
        lobe.weight = glm::abs(lobe.weight);
        side.lobes[std::size_t(side.count++)] = lobe;
    }
    BrdfEnergy out;
    for (int k = 0; k < BrdfEnergy::angles; ++k) {
        const int angle = k * BrdfEnergy::step_deg;
        const double albedo = mean_factor(gain, direction(angle, 0)) - mean_factor(loss, direction(angle, 0));
        out.albedo[std::size_t(k)] = albedo;
        // Larger by more than the integral's error, so that a constant albedo has its largest value at 0 degrees.
        if (k == 0 || albedo > out.largest * (1 + 1e-3) + 1e-6) out.largest = albedo, out.largest_deg = angle;
    }
    return out;
}

/// f itself, at angles in degrees; the azimuth between the directions is `turn`.
double f(const Bsdf& bsdf, double l_deg, double v_deg, double turn) {
    const Vec3f l = direction(l_deg, 0);
    const BsdfValue value = evaluate(bsdf, up, l, direction(v_deg, turn));
    return double(value.diffuse.x + value.specular.x) / double(l.z);
}

/// Calls `use(l, v, turn)` for pairs of angles in degrees: a grid, and pairs near the mirror direction, where narrow lobes
/// are not 0.
template <class Use> void for_pairs(const Use& use) {
    for (int l = 0; l <= 85; l += 5)
        for (const double turn : {180., 135., 90., 45., 0.})
            for (int v = l; v <= 85; v += 5) use(double(l), double(v), turn);
    for (int l = 0; l <= 80; l += 5)
        for (const double off : {0.1, 0.3, 1., 2.}) use(double(l), l + off, 180.);
}

void find_ratios(const Bsdf& bsdf, BrdfReport& report) {
    double peak = 0;
    report.least = f(bsdf, 0, 0, 0);
    for_pairs([&](double l, double v, double turn) {
        const double there = f(bsdf, l, v, turn), back = f(bsdf, v, l, turn);
        peak = std::max({peak, std::abs(there), std::abs(back)});
        report.least = std::min({report.least, there, back});
    });
    for_pairs([&](double l, double v, double turn) {
        const double there = f(bsdf, l, v, turn), back = f(bsdf, v, l, turn);
        if (!(std::min(std::abs(there), std::abs(back)) > 1e-6 * peak)) return;
        const double ratio = there / back, larger = std::max(ratio, 1 / ratio);
        if (larger <= report.reciprocity.ratio * (1 + 1e-6)) return;
        report.reciprocity = ratio > 1 ? BrdfRatio{larger, l, v, turn} : BrdfRatio{larger, v, l, turn};
    });
    const double there = f(bsdf, 20, 70, 180), back = f(bsdf, 70, 20, 180);
    if (std::min(std::abs(there), std::abs(back)) > 1e-12 * peak) report.ratio_20_70 = there / back;
}

/// The exponent from which weight * albedo(n) is at most 1; albedo falls with n.
template <class Albedo> double least_exponent(double weight, const Albedo& albedo) {
    double low = 0, high = 1e7;
    if (weight * albedo(low) <= 1) return 0;
    for (int step = 0; step < 80; ++step) {
        const double middle = (low + high) / 2;
        (weight * albedo(middle) > 1 ? low : high) = middle;
    }
    return high;
}

ExponentNeed exponent_need(const Lobe& lobe) {
    const double w = double(lobe.weight.x);
    const auto plain = lobe.kind == LobeKind::phong ? phong_albedo : blinn_albedo;
    const auto cosine = lobe.kind == LobeKind::phong ? phong_cosine_albedo : blinn_cosine_albedo;
    return {lobe.kind, w, least_exponent(w, plain), least_exponent(w, cosine), least_exponent(w / pi, plain)};
}

} // namespace

BrdfReport check_brdf(const std::string& spec, const Bsdf& bsdf) {
    BrdfReport report;
    report.spec = spec;
    Bsdf written = bsdf;
    for (int i = 0; i < written.count; ++i) {
        Lobe& lobe = written.lobes[std::size_t(i)];
        if (!as_its_author_wrote(lobe.kind)) continue;
        report.exponents.push_back(exponent_need(lobe));
        lobe.weight *= float(pi);
    }
    report.as_rendered = energy(bsdf);
    report.as_written = report.exponents.empty() ? report.as_rendered : energy(written);
    find_ratios(bsdf, report);
    auto& warnings = report.findings.warnings;
    if (!report.positive())
        warnings.push_back("negative: light would be taken away, down to f = " + number(report.least));
    if (!report.as_rendered.conserved())
        warnings.push_back("gains energy: of light from everywhere " + number(report.as_rendered.largest) +
                           " times as much is reflected at " + std::to_string(report.as_rendered.largest_deg) +
                           " degrees");
    return report;
}

} // namespace bake
