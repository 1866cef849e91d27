// The three requirements on a reflection model, measured: it is positive, it conserves energy, it is reciprocal.
#pragma once
#include "bake/light/lobe.h"
#include "bake/verdict/inspect.h"
#include <array>

namespace bake {

/// Directional albedo, the share of light that is reflected, at angles of view of 0, 5 ... 85 degrees.
struct BrdfEnergy {
    static constexpr int angles = 18, step_deg = 5;
    std::array<double, angles> albedo{};
    double largest = 0;
    int largest_deg = 0;                      ///< angle of view of `largest`
    static constexpr double tolerance = 2e-3; ///< of the numerical integral
    bool conserved() const noexcept { return largest <= 1 + tolerance; }
};

/// A ratio of f(from -> to) to f(to -> from); angles to the normal in degrees, `turn_deg` the azimuth between the two.
struct BrdfRatio {
    double ratio = 1;
    double from_deg = 0, to_deg = 0, turn_deg = 180;
    static constexpr double tolerance = 1e-3;
    bool reciprocal() const noexcept { return ratio <= 1 + tolerance; }
};

/// The exponents from which a lobe as of Phong or Blinn, alone, reflects at most 1; 0 if every exponent does.
struct ExponentNeed {
    LobeKind kind = LobeKind::phong;
    double weight = 1;
    double as_written = 0;  ///< for a light of irradiance 1 at normal incidence, which the formula multiplies by cos^n
    double with_cosine = 0; ///< the same with the factor n.l
    double as_rendered = 0; ///< for a light of radiance c that has the irradiance pi c
};

struct BrdfReport {
    std::string spec;       ///< what the user wrote
    double least = 0;       ///< least f found
    BrdfEnergy as_written;  ///< phong and blinn without the 1 / pi of `as_rendered`
    BrdfEnergy as_rendered; ///< as in light/lobe.h
    BrdfRatio reciprocity;  ///< the largest ratio of directions in which f is above 1e-6 of its peak
    double ratio_20_70 = 0; ///< f(20 -> 70 degrees) / f(70 -> 20 degrees) on opposite sides; 0 if f is 0 there
    std::vector<ExponentNeed> exponents;
    Findings findings;
    bool positive() const noexcept { return least >= 0; }
};

/// Of lobes without mirror and dielectric. Weights of lambert, phong and blinn may be negative.
BrdfReport check_brdf(const std::string& spec, const Bsdf& bsdf);

/// Aligned lines with a chart of the albedo, each with a newline at its end; and one JSON object.
std::string to_text(const BrdfReport& report);
std::string to_json(const BrdfReport& report);

} // namespace bake
