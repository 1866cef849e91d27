#include "bake/verdict/plan/verification.h"
#include "bake/base/progress.h"
#include "bake/verdict/plan/error_meter.h"
#include "bake/verdict/plan/joint.h"
#include <algorithm>
#include <limits>

namespace bake {
namespace {

constexpr int least_half = 4, most_half = 16; ///< samples of each half of a pixel

/// The predicted error of what is planned; nothing for the reference itself.
SquareEstimate predicted_of(const ObjectPlan& plan) {
    if (plan.chosen < 0) return {.all = true};
    const Rung& rung = plan.rungs[std::size_t(plan.chosen)];
    if (rung.known != Known::bound) return rung.error;
    return {.square = rung.bound * rung.bound, .all = true};
}

class Verifier {
public:
    Verifier(PlanWork& work, std::span<const ObjectDecision> decisions, std::span<const std::size_t> group,
             const Scene* shown)
        : work_(work), decisions_(decisions), group_(group), reference_(assemble_planned(work, decisions, group)),
          shown_(shown) {
        if (!shown_) planned_ = assemble_planned(work, decisions), shown_ = &planned_->scene;
    }

    void add(std::size_t camera, std::vector<Verification>& verified);

private:
    Verification compare(std::size_t camera, std::span<const std::uint8_t> of_object, const std::string& name,
                         double budget) const;

    PlanWork& work_;
    std::span<const ObjectDecision> decisions_;
    std::span<const std::size_t> group_;
    std::unique_ptr<AssembledScene> reference_, planned_;
    const Scene* shown_;
};

Verification Verifier::compare(std::size_t camera, std::span<const std::uint8_t> of_object, const std::string& name,
                               double budget) const {
    const ProbedScene both[] = {{&reference_->scene, of_object}, {shown_, of_object}};
    ProbeOptions options = probe_options(work_, camera, "verify " + name);
    options.half = std::clamp((options.settings.spp + 1) / 2, least_half, most_half);
    ErrorMeter meter(work_.options.budget.metric, both[0], object_pixels(both, options), options);
    Verification line;
    line.camera = work_.scenes.cameras()[camera].name, line.object = name;
    line.measured = meter.measure(both[1], std::numeric_limits<int>::max());
    line.flip = meter.pixels() > 0 ? meter.flip(both[1]) : 0;
    line.within = line.measured.low() <= StoppingRule{}.pass_at * budget;
    return line;
}

void Verifier::add(std::size_t camera, std::vector<Verification>& verified) {
    work_.scenes.light_for(reference_->scene, camera);
    if (planned_) work_.scenes.light_for(planned_->scene, camera);
    double squares = 0; ///< of what is predicted
    for (const std::size_t i : group_) {
        const ObjectPlan& plan = decisions_[i].plan;
        const std::vector<std::uint8_t> instances = work_.scenes.instances_of(decisions_[i].object);
        Verification line = compare(camera, instances, plan.object, plan.budget + plan.reference_error);
        line.predicted = predicted_of(plan);
        if (line.measured.pixels == 0) continue;
        squares += line.predicted.square * double(line.measured.pixels);
        verified.push_back(std::move(line));
    }
    Verification frame = compare(camera, {}, "", work_.options.budget.value);
    const double pixels = double(work_.scenes.settings().width) * work_.scenes.settings().height;
    frame.predicted.square = squares / pixels;
    frame.predicted.pixels = std::int64_t(pixels);
    verified.push_back(std::move(frame));
}

/// Of several lines for the whole picture of a camera, the one with the largest error.
void keep_worst_frames(std::vector<Verification>& verified) {
    std::vector<Verification> kept;
    for (Verification& line : verified) {
        const auto same = std::find_if(kept.begin(), kept.end(), [&](const Verification& other) {
            return line.object.empty() && other.object.empty() && other.camera == line.camera;
        });
        if (same == kept.end()) kept.push_back(std::move(line));
        else if (line.measured.square > same->measured.square) *same = std::move(line);
    }
    verified = std::move(kept);
}

} // namespace

std::vector<Verification> verify(PlanWork& work, std::span<const ObjectDecision> decisions, const Scene* shown) {
    std::vector<Verification> verified;
    for (const std::vector<std::size_t>& group : reference_groups(decisions)) {
        Verifier verifier(work, decisions, group, shown);
        for (std::size_t camera = 0; camera < work.scenes.cameras().size(); ++camera) {
            if (work.progress) work.progress->start("verify " + work.scenes.cameras()[camera].name, 0);
            verifier.add(camera, verified);
        }
    }
    keep_worst_frames(verified);
    return verified;
}

} // namespace bake
