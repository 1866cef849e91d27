#include "bake/base/text.h"
#include "bake/verdict/plan/relief_facts.h"

namespace bake {
namespace {

/// Without an exponent and without digits that nobody needs.
std::string px(double value) {
    return value < 0.01 ? "less than 0.01 px" : format(value < 9.95 ? "%.2g px" : "%.0f px", value);
}

std::string about_contour(const ReliefFacts& facts) {
    if (facts.contour_px == 0) return "no relief lies within 3 px of a contour";
    return "the outline moves by up to " + px(facts.contour_px);
}

std::string about_light(const ReliefFacts& facts) {
    const double above = facts.sun_above_horizon_deg;
    if (above >= 90) return "";
    if (above > 0) return format(", the lowest light stands %.0f deg above the horizon angle of the relief", above);
    return format(", the lowest light stands %.0f deg below the horizon angle of the relief, which casts shadows",
                  -above);
}

} // namespace

std::string why_enough(const ShadeMethod& method, const ReliefFacts& facts) {
    const std::string start = name(method) + " is enough: ";
    if (!facts.in_view) return start + "no part of the object lies in the picture";
    std::string text = start + "the relief is up to " + px(facts.height_px) + " high, " + about_contour(facts);
    if (displaces(method.shade)) return text;
    text += about_light(facts);
    // Tables of slopes leave it out; it shows from about half a per cent on.
    const bool bent =
        method.shade == Shade::bump || method.shade == Shade::bump_roughness || method.shade == Shade::normal;
    if (bent && facts.most_bend > 0.005) text += format(", max |height x curvature| is %.2g", facts.most_bend);
    return text;
}

} // namespace bake
