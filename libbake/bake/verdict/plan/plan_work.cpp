#include "bake/verdict/plan/plan_work.h"
#include "bake/preview/sampler.h"
#include <algorithm>

namespace bake {

void PlanWork::note(const std::string& line) {
    if (std::find(notes.begin(), notes.end(), line) == notes.end()) notes.push_back(line);
}

const ShadeMethod& chosen_method(const ObjectPlan& plan) noexcept {
    return plan.chosen < 0 ? plan.reference : plan.rungs[std::size_t(plan.chosen)].method;
}

ProbeOptions probe_options(const PlanWork& work, std::size_t camera, const std::string& name) {
    ProbeOptions options;
    options.settings = work.scenes.settings();
    options.camera = work.scenes.cameras()[camera].camera;
    options.exposure = work.exposure;
    std::uint64_t seed = hash(std::uint64_t(work.options.seed) << 32 | options.settings.seed) + camera;
    for (const char letter : name) seed = hash(seed ^ std::uint64_t(static_cast<unsigned char>(letter)));
    options.seed = std::uint32_t(hash(seed) >> 32);
    return options;
}

} // namespace bake
