#include "bake/verdict/plan/object_facts.h"
#include <algorithm>

namespace bake {
namespace {

void add_worse(const ReliefFacts& facts, ReliefFacts& worst) noexcept {
    worst.height_px = std::max(worst.height_px, facts.height_px);
    worst.contour_px = std::max(worst.contour_px, facts.contour_px);
    worst.most_slope = std::max(worst.most_slope, facts.most_slope);
    worst.most_bend = std::max(worst.most_bend, facts.most_bend);
    worst.sun_above_horizon_deg = std::min(worst.sun_above_horizon_deg, facts.sun_above_horizon_deg);
    worst.texel_px = std::max(worst.texel_px, facts.texel_px);
    worst.in_view = worst.in_view || facts.in_view;
}

} // namespace

ObjectFacts::ObjectFacts(const PlanScenes& scenes, const Scene& plain, int object, float exposure) {
    const PlannedObject& of = scenes.objects()[std::size_t(object)];
    for (const PlannedCamera& camera : scenes.cameras()) {
        ReliefFacts& worst = of_cameras_.emplace_back();
        for (const std::uint32_t instance : of.instances) {
            FactsInput input{.scene = &plain,
                             .instance = instance,
                             .relief = of.height.get(),
                             .options = of.relief,
                             .camera = camera.camera,
                             .exposure = exposure,
                             .width = scenes.settings().width,
                             .height = scenes.settings().height};
            const ReliefFacts facts = relief_facts(input);
            add_worse(facts, worst);
            views_.push_back({std::move(input), facts});
        }
    }
}

std::optional<ErrorBound> ObjectFacts::bound(Shade shade) const {
    std::optional<ErrorBound> largest;
    for (const View& view : views_) {
        std::optional<ErrorBound> bound = error_bound(shade, view.input, view.facts);
        if (!bound) return {};
        if (!largest || bound->rmse > largest->rmse) largest = std::move(bound);
    }
    return largest;
}

bool ObjectFacts::in_view() const noexcept {
    return std::any_of(of_cameras_.begin(), of_cameras_.end(), [](const ReliefFacts& facts) { return facts.in_view; });
}

ReliefFacts ObjectFacts::worst() const noexcept {
    ReliefFacts worst;
    for (const ReliefFacts& facts : of_cameras_) add_worse(facts, worst);
    return worst;
}

} // namespace bake
