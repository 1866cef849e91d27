// What a relief looks like from a camera and under the lights, without rendering: sizes in pixels, angles, and upper bounds
// of the picture error that follow from them.
#pragma once
#include "bake/preview/relief_method.h"
#include "bake/preview/scene.h"
#include <optional>
#include <string>

namespace bake {

/// An object as a camera sees it, from points of all its triangles that face the camera or not.
struct ReliefFacts {
    double height_px = 0;  ///< largest |b| times sin of the angle between normal and view, projected
    double contour_px = 0; ///< the same over points within 3 pixels of a contour (normal perpendicular to the view)
    double most_slope = 0; ///< of the displaced surface against the base, as a tangent
    double most_bend = 0;  ///< |height x curvature|
    double sun_above_horizon_deg =
        90;               ///< least over lights and points: light's elevation minus the relief's horizon angle
    double texel_px = 0;  ///< median size of a height texel in pixels
    bool in_view = false; ///< some point lies in the picture
};

struct FactsInput {
    const Scene* scene = nullptr; ///< without relief, built
    std::uint32_t instance = 0;
    const HeightTexture* relief = nullptr;
    ReliefOptions options; ///< what its values mean; the method is not looked at
    Camera camera;
    float exposure = 0;        ///< stops
    int width = 0, height = 0; ///< of the picture
};

ReliefFacts relief_facts(const FactsInput& input);

/// An upper bound of the RMSE (see budget.h) of a method against true displacement, with a sentence that says why; nothing
/// where none is known. It is never below the true error: tests look for a counterexample.
struct ErrorBound {
    double rmse = 0;
    std::string why;
};
std::optional<ErrorBound> error_bound(Shade shade, const FactsInput& input, const ReliefFacts& facts);

/// "bump is enough: the relief is 0.4 px high from every camera, no contour within 3 px, ...".
std::string why_enough(const ShadeMethod& method, const ReliefFacts& facts);

} // namespace bake
