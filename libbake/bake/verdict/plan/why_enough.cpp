#include "bake/base/text.h"
#include "bake/verdict/plan/relief_facts.h"

namespace bake {
namespace {

/// "up to 0.4 px", without an exponent and without digits that nobody needs.
std::string up_to(double px) {
    if (px < 0.01) return "less than 0.01 px";
    return format(px < 9.95 ? "up to %.2g px" : "up to %.0f px", px);
}

std::string about_contour(const ReliefFacts& facts) {
    if (facts.contour_px == 0) return "no relief lies within 3 px of a contour";
    return "the outline moves by " + up_to(facts.contour_px);
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
    std::string text = start + "the relief is " + up_to(facts.height_px) + " high, " + about_contour(facts);
    if (displaces(method.shade)) return text;
    text += about_light(facts);
    // Tables of slopes leave it out; it shows from about half a per cent on.
    const bool bent =
        method.shade == Shade::bump || method.shade == Shade::bump_roughness || method.shade == Shade::normal;
    if (bent && facts.most_bend > 0.005) text += format(", max |height x curvature| is %.2g", facts.most_bend);
    return text;
}

} // namespace bake
