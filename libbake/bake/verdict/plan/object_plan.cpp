#include "bake/verdict/plan/object_plan.h"
#include "bake/base/error.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include "bake/verdict/plan/high_words.h"
#include "bake/verdict/plan/references.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Triangles of a reference per pixel of the object: of the first one, whose edges are about a quarter of a pixel, and of the
/// finest, whose edges are about an eighth. Half of them are behind.
constexpr double least_triangles = 32, most_triangles = 256;
constexpr double triangles_together = 1.2e7; ///< of the references of objects that are judged in the same scenes
constexpr int neighbour_pixels = 256;        ///< on which the next dearer rung is measured
constexpr const char* nothing_cheaper = "no cheaper model is within the budget";

/// Four times per edge, or twice where no such grid will do and the reference is as fine as it has to be.
bool is_coarser_than_reference(const Candidate& c, const Rung& rung) noexcept {
    return !displaces(rung.method.shade) || rung.method.levels + (c.halved ? 1 : 2) <= c.level;
}

class Decider {
public:
    Decider(PlanWork& work, std::span<ObjectDecision> decisions);
    void run();

private:
    void begin(Candidate& c);
    void list_rungs(Candidate& c) const;
    void leave_out_dearer_than_high(ObjectPlan& plan) const;
    bool is_settled_unseen(Candidate& c);
    bool tries_half(Candidate& c) const;
    std::unique_ptr<AssembledScene> next_scene();
    void probe(Candidate& c, AssembledScene& scene);
    void choose(Candidate& c, Known known);
    void finish(Candidate& c, const std::string& why);
    void add_flip(Candidate& c, AssembledScene& chosen);
    void measure_dearer(Candidate& c);
    std::shared_ptr<const BakedModel> baked(const Candidate& c, Rung& rung);
    void light_for(AssembledScene& scene, std::size_t camera) {
        work_.scenes.light_for(references_.scene().scene, camera);
        work_.scenes.light_for(scene.scene, camera);
    }

    PlanWork& work_;
    std::vector<Candidate> candidates_;
    References references_;
    std::unique_ptr<AssembledScene> previous_; ///< with the rungs that were probed last
};

Decider::Decider(PlanWork& work, std::span<ObjectDecision> decisions) : work_(work), references_(work) {
    for (ObjectDecision& decision : decisions) {
        Candidate& c = candidates_.emplace_back();
        c.decision = &decision;
        c.instances = work.scenes.instances_of(decision.object);
    }
}

void Decider::list_rungs(Candidate& c) const {
    const PlannedObject& object = work_.scenes.objects()[std::size_t(c.decision->object)];
    ObjectPlan& plan = c.plan();
    plan.object = object.name, plan.material = object.material, plan.meshes = object.meshes;
    plan.high = object.high.file;
    plan.budget = work_.options.budget.value;
    plan.rgb8_bytes = map_bytes(c.cost.width, c.cost.height, 3);
    for (const ShadeMethod& method : c.has_high() ? plan_high_rungs() : plan_rungs(c.cost.triangles)) {
        Rung rung;
        rung.method = method, rung.cost = model_cost(c.cost, method);
        if (method.shade == Shade::high) rung.known = Known::bound, rung.note = "it is the reference";
        plan.rungs.push_back(std::move(rung));
    }
    const CostWeights& weights = work_.options.weights;
    std::stable_sort(plan.rungs.begin(), plan.rungs.end(),
                     [&](const Rung& a, const Rung& b) { return a.cost.total(weights) < b.cost.total(weights); });
    if (c.has_high()) leave_out_dearer_than_high(plan);
    plan.reference = reference_at(c, first_level(c));
    plan.reference_cost = model_cost(c.cost, plan.reference);
}

/// Nothing is gained by what costs more than the reference.
void Decider::leave_out_dearer_than_high(ObjectPlan& plan) const {
    while (plan.rungs.back().method.shade != Shade::high) {
        work_.note(plan.object + ": its \"" + name(plan.rungs.back().method) +
                   "\" costs more than the high-poly mesh and is no candidate");
        plan.rungs.pop_back();
    }
}

void Decider::begin(Candidate& c) {
    const PlannedObject& object = work_.scenes.objects()[std::size_t(c.decision->object)];
    look_at(c, object);
    const double pixels = pixels_in_view(work_, c);
    c.first_triangles = std::clamp(least_triangles * pixels, candidates_.size() > 1 ? 4e3 : 2e4, 1e5);
    const double together = triangles_together / double(candidates_.size());
    c.most_refined = std::min(5e6, together);
    c.most_triangles = std::clamp(most_triangles * pixels, std::min(1e6, together), together);
    c.facts.emplace(work_.scenes, work_.plain->scene, c.decision->object, work_.exposure);
    ObjectPlan& plan = c.plan();
    if (plan.rungs.empty()) list_rungs(c);
    else c.next = std::size_t(plan.chosen + 1);
    plan.chosen = -1;
    plan.facts = c.facts->of_cameras();
    if (c.facts->in_view() || pixels > 0) return;
    c.rung().error.all = true;
    choose(c, Known::bound);
    plan.why = "not in view";
}

/// Settles rungs by what is known without rendering, up to one that needs a probe. True if the object is done.
bool Decider::is_settled_unseen(Candidate& c) {
    const Budget& budget = work_.options.budget;
    for (; !c.done && c.has_rung(); ++c.next) {
        Rung& rung = c.rung();
        std::optional<ErrorBound> bound;
        // Clamped values differ by no more than 1, and neither does FLIP.
        if (std::isinf(budget.value) || (budget.metric != Budget::Metric::degrees && budget.value >= 1))
            bound = ErrorBound{1, "no error is larger than the budget"};
        else if (rung.method.shade == Shade::high) bound = ErrorBound{0, "it is the reference"};
        else if (budget.metric == Budget::Metric::rmse && !c.has_high()) bound = c.facts->bound(rung.method.shade);
        // Nothing but the reference is without error, unless there is no relief.
        if (budget.value == 0 && c.has_relief) {
            finish(c, nothing_cheaper);
            return true;
        }
        if (!bound || bound->rmse > budget.value) return false;
        rung.bound = bound->rmse, rung.note = bound->why;
        choose(c, Known::bound);
        return true;
    }
    // The reference that is shown is one whose error is known and small.
    if (!c.done && (c.level < 0 || references_.is_too_coarse(c))) return false;
    if (!c.done && tries_half(c)) return false;
    if (!c.done) finish(c, nothing_cheaper);
    return true;
}

/// Whether the mesh of half the reference's segments becomes the next rung.
bool Decider::tries_half(Candidate& c) const {
    if (c.halved || c.level < 1) return false;
    c.halved = true;
    const ShadeMethod method{Shade::displace, c.level - 1};
    std::vector<Rung>& rungs = c.plan().rungs;
    auto rung = std::find_if(rungs.begin(), rungs.end(), [&](const Rung& other) {
        return other.method.shade == method.shade && other.method.levels == method.levels;
    });
    if (rung == rungs.end()) {
        rung = rungs.emplace(rung);
        rung->method = method, rung->cost = model_cost(c.cost, method);
    }
    if (rung->known == Known::probe || rung->known == Known::not_settled) return false;
    rung->known = Known::not_tried, rung->note.clear();
    c.next = std::size_t(rung - rungs.begin());
    return true;
}

/// Null, with a note, for a method that does not suit the object.
std::shared_ptr<const BakedModel> Decider::baked(const Candidate& c, Rung& rung) {
    try {
        return work_.scenes.bake(c.decision->object, rung.method);
    } catch (const Error& error) {
        if (error.refusal != Refusal::unsuitable) throw;
        rung.known = Known::skipped;
        rung.note = error.what();
        return nullptr;
    }
}

/// Each object with its next rung; those that are done, as in the reference. Null if a rung had to be skipped, or none is left.
std::unique_ptr<AssembledScene> Decider::next_scene() {
    BakedModels models = references_.scene().models;
    bool complete = true, any = false;
    for (Candidate& c : candidates_) {
        if (c.done || !c.has_rung()) continue;
        any = true;
        Rung& rung = c.rung();
        std::shared_ptr<const BakedModel> model;
        if (is_coarser_than_reference(c, rung)) model = baked(c, rung);
        else rung.known = Known::skipped, rung.note = "the finest reference is less than four times finer";
        if (!model) complete = false, ++c.next;
        else models[std::size_t(c.decision->object)] = std::move(model);
    }
    return complete && any ? work_.scenes.assemble(std::move(models)) : nullptr;
}

/// The camera that refused the last rung is asked first. Where the error of the reference leaves the judgement open, the
/// candidate waits for a finer one.
void Decider::probe(Candidate& c, AssembledScene& scene) {
    Rung& rung = c.rung();
    const double budget = work_.options.budget.value;
    const std::size_t first = c.worst;
    const bool can_be_finer = references_.is_too_coarse(c);
    bool open = false, refused = false;
    for (std::size_t i = 0; i < c.meters.size(); ++i) {
        const std::size_t camera = (first + i) % c.meters.size();
        light_for(scene, camera);
        const auto [estimate, settled] =
            c.meters[camera].judge(c.of(scene), budget, c.plan().reference_error, can_be_finer);
        rung.known = Known::probe;
        if (i == 0 || settled == Settled::over || estimate.square > rung.error.square) {
            rung.error = estimate, rung.camera = work_.scenes.cameras()[camera].name;
            c.worst = camera;
        }
        if (settled == Settled::within) continue;
        open = settled == Settled::open;
        c.waits = open && can_be_finer;
        if (c.waits) return;
        refused = refused || !open || !acceptable(estimate, budget, c.plan().reference_error);
        if (settled == Settled::over) break;
    }
    if (open) rung.known = Known::not_settled;
    if (work_.options.measure) rung.cost.ms = c.meters[c.worst].ms(c.of(scene));
    if (!refused) choose(c, rung.known);
}

void Decider::choose(Candidate& c, Known known) {
    c.rung().known = known;
    c.plan().chosen = int(c.next);
    finish(c, c.has_high() ? why_of_high(c.rung(), c.cost, work_.options.budget.metric)
                           : why_enough(c.rung().method, c.facts->worst()));
}

void Decider::finish(Candidate& c, const std::string& why) {
    c.done = true;
    c.decision->decided = true;
    c.plan().why = why;
    if (References::is_limited_by_memory(c))
        work_.note(format("%s: its reference is %s, the finest that fits in memory", c.plan().object.c_str(),
                          name(c.plan().reference).c_str()));
    if (!work_.options.told) return;
    const std::string method = name(chosen_method(c.plan()));
    work_.options.told(c.plan().object + ": " + (why.starts_with(method) ? why : method + "; " + why));
}

/// Of the chosen rung, and of the one that was probed before it.
void Decider::add_flip(Candidate& c, AssembledScene& chosen) {
    light_for(chosen, c.worst);
    c.rung().flip = c.meters[c.worst].flip(c.of(chosen));
    if (!c.probed || !previous_) return;
    light_for(*previous_, c.worst);
    c.plan().rungs[c.last].flip = c.meters[c.worst].flip(c.of(*previous_));
}

/// What the next rung behind the chosen one would have erred, as long as the reference is fine enough for it.
void Decider::measure_dearer(Candidate& c) {
    std::vector<Rung>& rungs = c.plan().rungs;
    for (std::size_t i = c.next + 1; i < rungs.size(); ++i) {
        Rung& rung = rungs[i];
        if (rung.known != Known::not_tried) continue;
        if (!is_coarser_than_reference(c, rung)) return;
        const auto model = baked(c, rung);
        if (!model) continue;
        BakedModels models = references_.scene().models;
        models[std::size_t(c.decision->object)] = model;
        const auto scene = work_.scenes.assemble(std::move(models));
        light_for(*scene, c.worst);
        rung.error = c.meters[c.worst].measure(c.of(*scene), neighbour_pixels);
        rung.camera = work_.scenes.cameras()[c.worst].name;
        rung.known = Known::probe;
        return;
    }
}

void Decider::run() {
    for (Candidate& c : candidates_) begin(c);
    for (;;) {
        bool open = false;
        for (Candidate& c : candidates_) open = !(c.done || is_settled_unseen(c)) || open;
        if (!open) return;
        references_.prepare(candidates_);
        std::unique_ptr<AssembledScene> scene = next_scene();
        if (!scene) continue;
        bool went_on = false;
        for (Candidate& c : candidates_) {
            if (c.done || !c.has_rung()) continue;
            if (work_.progress) work_.progress->start("plan " + c.plan().object + ": " + name(c.rung().method), 0);
            probe(c, *scene);
            if (c.done && work_.options.neighbours) {
                add_flip(c, *scene);
                if (candidates_.size() == 1) measure_dearer(c);
            }
            if (!c.done && !c.waits) c.last = c.next++, c.probed = true;
            went_on = went_on || !c.waits;
        }
        if (!went_on) continue;
        previous_ = std::move(scene);
        for (Candidate& c : candidates_) c.probed = c.probed && !c.waits; // previous_ does not show its last rung
    }
}

} // namespace

void decide(PlanWork& work, std::span<ObjectDecision> decisions) { Decider(work, decisions).run(); }

} // namespace bake
