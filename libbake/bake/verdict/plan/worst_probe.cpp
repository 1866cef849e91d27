#include "bake/verdict/plan/worst_probe.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include <algorithm>

namespace bake {
namespace {

/// Of two estimates, the one that may be larger.
bool worse(const SquareEstimate& a, const SquareEstimate& b) noexcept { return a.high() > b.high(); }

} // namespace

std::vector<PartOptions::View> views_of(const Scene& scene, const PartOptions& options) {
    if (!options.views.empty()) return options.views;
    return {{"", scene.camera}};
}

ObjectMask objects_with(const Scene& scene, std::span<const Material* const> materials) {
    ObjectMask mask(scene.instances.size());
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask[i] = std::find(materials.begin(), materials.end(), scene.instances[i].material) != materials.end();
    return mask;
}

std::vector<ObjectMask> frame_and_materials(const Scene& scene, int most) {
    std::vector<ObjectMask> objects = {{}};
    std::vector<const Material*> seen;
    for (const Instance& instance : scene.instances)
        if (std::find(seen.begin(), seen.end(), instance.material) == seen.end()) seen.push_back(instance.material);
    if (int(seen.size()) > most) {
        objects.push_back(objects_with(scene, std::span(seen).subspan(std::size_t(most))));
        seen.resize(std::size_t(most));
    }
    for (const Material*& material : seen) objects.push_back(objects_with(scene, {&material, 1}));
    return objects;
}

WorstProbe::WorstProbe(const Scene& reference, std::vector<ObjectMask> objects, const PartOptions& options)
    : rule_(options.rule) {
    for (ObjectMask& object : objects) objects_.push_back(std::make_unique<ObjectMask>(std::move(object)));
    for (const PartOptions::View& view : views_of(reference, options)) {
        ProbeOptions probe;
        probe.settings = reference.settings;
        probe.camera = view.camera;
        probe.exposure = options.exposure;
        probe.seed = options.seed;
        probe.half = options.half;
        for (const auto& object : objects_) {
            const ProbedScene scene{&reference, *object};
            std::vector<Pixel> pixels = object_pixels({&scene, 1}, probe);
            if (pixels.empty()) continue;
            probes_.push_back(
                std::make_unique<Part>(Part{object.get(), view.name, ReferenceProbe(scene, std::move(pixels), probe)}));
        }
    }
}

WorstProbe::Result WorstProbe::judge(const Scene& candidate, double budget) {
    Result result{.within = true};
    for (const auto& part : probes_) {
        throw_if_interrupted();
        const ReferenceProbe::Result one = part->probe.judge({&candidate, *part->object}, budget, 0, rule_);
        if (worse(one.estimate, result.error) || result.error.pixels == 0)
            result.error = one.estimate, result.camera = part->camera;
        if (one.settled == Settled::within) continue;
        result.within = one.settled == Settled::open && acceptable(one.estimate, budget, 0, rule_);
        result.settled = one.settled != Settled::open && result.settled;
        if (result.within) continue;
        result.error = one.estimate, result.camera = part->camera;
        break;
    }
    return result;
}

WorstProbe::Result WorstProbe::measure(const Scene& candidate, int pixels) {
    Result result;
    for (const auto& part : probes_) {
        throw_if_interrupted();
        const SquareEstimate one = part->probe.measure({&candidate, *part->object}, pixels);
        if (worse(one, result.error) || result.error.pixels == 0) result.error = one, result.camera = part->camera;
    }
    return result;
}

std::string error_text(const SquareEstimate& error) {
    if (error.pixels == 0) return "0";
    return format("%.2g (%.2g to %.2g)", error.rmse(), error.low(), error.high());
}

} // namespace bake
