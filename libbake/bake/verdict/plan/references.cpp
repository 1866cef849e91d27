#include "bake/verdict/plan/references.h"
#include "bake/base/error.h"
#include "bake/verdict/plan/relief_scale.h"
#include "bake/verdict/plan/relief_waves.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr int most_levels = 10; ///< of a displacement
constexpr double edges_per_wave = 12;
constexpr int measured_pixels = 256;
constexpr double tolerable = 0.15; ///< error of a reference, as a part of the budget

/// Makes the reference finer, up to `level` and a number of triangles. Returns whether it changed.
bool raise(Candidate& c, int level, double most) noexcept {
    level = std::min(level, c.most_level);
    while (level > 0 && level > c.level && displaced_triangles(c, level) > most) --level;
    const bool finer = level > c.level;
    c.level = std::max(level, c.level);
    return finer;
}

/// For the next rung.
int wanted_level(const Candidate& c) noexcept {
    const int first = first_level(c);
    return c.has_rung() && !c.halved && displaces(c.rung().method.shade) ? std::max(first, c.rung().method.levels + 2)
                                                                         : first;
}

void look_at_height(Candidate& c, const PlannedObject& object) {
    const Image<float>& height = object.height->values;
    c.cost.width = height.width(), c.cost.height = height.height();
    c.edge = edge_texels(*object.shape, height.width(), height.height());
    const ReliefWaves waves = relief_waves(*object.height, object.relief.height.wrap_u, object.relief.height.wrap_v);
    c.shortest = std::min(waves.u, waves.v);
    const HeightOptions& options = object.relief.height;
    c.has_relief =
        options.amplitude != 0 && std::any_of(height.data(), height.data() + height.size(),
                                              [&](float value) { return double(value) != options.midlevel; });
}

} // namespace

void look_at(Candidate& candidate, const PlannedObject& object) {
    candidate.cost.triangles = std::int64_t(object.shape->surface.triangles.size());
    candidate.cost.meshes = int(object.instances.size());
    if (!object.high_model) return look_at_height(candidate, object);
    candidate.cost.width = candidate.cost.height = object.high.size;
    candidate.cost.high = object.high_model->triangles;
}

double pixels_in_view(const PlanWork& work, const Candidate& candidate) {
    const auto most_of = [&](const AssembledScene& shown) {
        const ProbedScene scene = candidate.of(shown);
        std::size_t most = 0;
        for (std::size_t camera = 0; camera < work.scenes.cameras().size(); ++camera)
            most = std::max(most, object_pixels(std::span(&scene, 1), probe_options(work, camera, "")).size());
        return double(most);
    };
    const double plain = most_of(*work.plain);
    if (plain > 0 || !candidate.has_high()) return plain;
    const auto object = std::size_t(candidate.decision->object);
    BakedModels models(work.scenes.objects().size());
    models[object] = work.scenes.objects()[object].high_model;
    return most_of(*work.scenes.assemble(std::move(models)));
}

ShadeMethod reference_at(const Candidate& candidate, int level) noexcept {
    return candidate.has_high() ? ShadeMethod{Shade::high} : ShadeMethod{Shade::displace, level};
}

double displaced_triangles(const Candidate& candidate, int level) noexcept {
    if (candidate.has_high()) return double(candidate.cost.high) * candidate.cost.meshes;
    return double(candidate.cost.triangles) * candidate.cost.meshes * std::exp2(2.0 * level);
}

int first_level(const Candidate& candidate) noexcept {
    if (candidate.has_high()) return 0;
    int level = 0;
    while (level < most_levels && displaced_triangles(candidate, level) < candidate.first_triangles) ++level;
    // One that is coarser by a level tells the error of the reference.
    if (level == 0 && displaced_triangles(candidate, 1) <= candidate.most_refined) level = 1;
    return level;
}

/// Where it does not fit in memory, a coarser one.
void References::bake(Candidate& c) {
    for (;; --c.level) {
        try {
            c.decision->reference = work_.scenes.bake(c.decision->object, reference_at(c, c.level));
            break;
        } catch (const Error& error) {
            if (error.refusal != Refusal::unsuitable || c.level == 0) throw;
            c.most_level = c.level - 1;
        }
    }
    c.plan().reference = reference_at(c, c.level);
    c.plan().reference_cost = model_cost(c.cost, c.plan().reference);
}

void References::make_meters(Candidate& c) {
    const ProbedScene both[] = {c.of(*scene_), c.of(*work_.plain)};
    c.decision->area.clear();
    for (std::size_t camera = 0; camera < work_.scenes.cameras().size(); ++camera) {
        const ProbeOptions options = probe_options(work_, camera, c.plan().object);
        c.meters.emplace_back(work_.options.budget.metric, both[0], object_pixels(both, options), options);
        c.decision->area.push_back(double(c.meters.back().pixels()));
    }
}

void References::build(std::vector<Candidate>& candidates) {
    for (;;) {
        try {
            return try_build(candidates);
        } catch (const Error& error) {
            if (error.refusal != Refusal::unsuitable || !coarsen(candidates)) throw;
        } catch (const std::bad_alloc&) {
            if (!coarsen(candidates)) throw;
        }
    }
}

/// Meshes that fit one by one need not fit together with the tree over them. False if the largest cannot be coarser.
bool References::coarsen(std::vector<Candidate>& candidates) {
    Candidate* largest = nullptr;
    for (Candidate& c : candidates) {
        if (c.done) continue;
        c.measured = -1;
        if (c.level > 0 &&
            (!largest || displaced_triangles(c, c.level) > displaced_triangles(*largest, largest->level)))
            largest = &c;
    }
    if (!largest) return false;
    largest->most_level = --largest->level;
    return true;
}

void References::try_build(std::vector<Candidate>& candidates) {
    for (Candidate& c : candidates) c.meters.clear();
    scene_.reset();
    BakedModels models(work_.scenes.objects().size());
    for (Candidate& c : candidates) {
        if (!c.done) bake(c);
        models[std::size_t(c.decision->object)] = c.decision->reference;
    }
    scene_ = work_.scenes.assemble(std::move(models));
    for (Candidate& c : candidates)
        if (!c.done) make_meters(c);
    measure(candidates);
}

/// Of the references that changed.
void References::measure(std::vector<Candidate>& candidates) {
    BakedModels models = scene_->models;
    std::vector<Candidate*> changed;
    for (Candidate& c : candidates) {
        if (c.done || c.level == c.measured) continue;
        c.measured = c.level;
        c.plan().reference_error = 0;
        if (c.level == 0) continue;
        models[std::size_t(c.decision->object)] = work_.scenes.bake(c.decision->object, {Shade::displace, c.level - 1});
        changed.push_back(&c);
    }
    if (changed.empty()) return;
    const auto coarse = work_.scenes.assemble(std::move(models));
    for (Candidate* c : changed) {
        const bool resolved = c->edge / std::exp2(c->level) * edges_per_wave <= c->shortest;
        for (std::size_t camera = 0; camera < c->meters.size(); ++camera) {
            work_.scenes.light_for(scene_->scene, camera), work_.scenes.light_for(coarse->scene, camera);
            const double change = c->meters[camera].measure(c->of(*coarse), measured_pixels).rmse();
            c->plan().reference_error = std::max(c->plan().reference_error, change / (resolved ? 3 : 1));
        }
    }
}

bool References::is_too_coarse(const Candidate& c) const noexcept {
    const double budget = work_.options.budget.value;
    return budget > 0 && c.plan().reference_error > tolerable * budget && c.level < c.most_level &&
           displaced_triangles(c, c.level + 1) <= c.most_refined;
}

bool References::is_limited_by_memory(const Candidate& c) noexcept {
    return !c.has_high() && c.level >= 0 && c.level == c.most_level && c.level < most_levels;
}

void References::prepare(std::vector<Candidate>& candidates) {
    bool changed = !scene_;
    for (Candidate& c : candidates) {
        if (c.done) continue;
        if (c.level < 0) c.most_level = c.has_high() ? 0 : most_levels;
        changed = raise(c, wanted_level(c), c.most_triangles) || changed;
        if (c.waits) changed = raise(c, c.level + 1, c.most_refined) || changed;
        c.waits = false;
    }
    for (;;) {
        if (changed) build(candidates);
        changed = false;
        for (Candidate& c : candidates)
            if (!c.done && !c.has_rung() && is_too_coarse(c))
                changed = raise(c, c.level + 1, c.most_refined) || changed;
        if (!changed) return;
    }
}

} // namespace bake
