// The displaced and the high-poly meshes that objects are judged against, and how far displaced ones are from finer ones. Internal
// to this room.
//
// A reference is small at first. It becomes at least four times finer per edge than a displaced rung in question, and finer
// where its own error leaves the judgement of a rung open, or is shown because no rung is within the budget. With d the error of a mesh of twice the edges against it, its own error is
// taken to be d / 3 where 12 of its edges make the shortest wave of the height, because errors of order 2 fall to a quarter
// (Richardson, 1911), and d where its edges are longer than that.
#pragma once
#include "bake/verdict/plan/error_meter.h"
#include "bake/verdict/plan/object_facts.h"
#include "bake/verdict/plan/plan_cost.h"
#include "bake/verdict/plan/plan_work.h"

namespace bake {

/// One object on its way to a decision.
struct Candidate {
    ObjectDecision* decision = nullptr;
    std::vector<std::uint8_t> instances; ///< a flag for each of the scene
    std::optional<ObjectFacts> facts;
    CostInput cost;
    double edge = 0;        ///< of the mesh, texels
    double shortest = 0;    ///< wave of the height, texels
    bool has_relief = true; ///< some height is not 0, or there is a high-poly mesh
    std::size_t next = 0;   ///< rung
    std::size_t last = 0;   ///< the last one that was probed before
    bool probed = false;    ///< whether there is one
    std::size_t worst = 0;  ///< the camera that refused the last rung
    bool done = false;
    double first_triangles = 1e5;   ///< of all meshes, with which the reference begins
    double most_refined = 5e6;      ///< beyond which it is not refined for its own error
    double most_triangles = 1.2e7;  ///< beyond which it is not refined for the sake of a rung
    int level = -1;                 ///< of the reference
    int measured = -1;              ///< the level whose error is known
    int most_level = 0;             ///< finer ones do not fit
    bool waits = false;             ///< for a finer reference, to judge the next rung again
    bool halved = false;            ///< no rung will do, and grids of half the reference's segments are tried
    std::vector<ErrorMeter> meters; ///< one per camera

    bool has_high() const noexcept { return cost.high > 0; }
    ObjectPlan& plan() const noexcept { return decision->plan; }
    Rung& rung() const noexcept { return decision->plan.rungs[next]; }
    bool has_rung() const noexcept { return next < decision->plan.rungs.size(); }
    ProbedScene of(const AssembledScene& scene) const noexcept { return {&scene.scene, instances}; }
};

/// Sets what the object tells of its cost and its relief.
void look_at(Candidate& candidate, const PlannedObject& object);
/// Of the camera that sees most of the object without relief; of its high-poly mesh where no camera sees that.
double pixels_in_view(const PlanWork& work, const Candidate& candidate);
/// The reference by its level. A high-poly mesh is one at level 0, and there is no finer one.
ShadeMethod reference_at(const Candidate& candidate, int level) noexcept;
/// Triangles of all meshes of an object, displaced, or those of its high-poly mesh.
double displaced_triangles(const Candidate& candidate, int level) noexcept;
/// With which a reference begins.
int first_level(const Candidate& candidate) noexcept;

class References {
public:
    explicit References(PlanWork& work) : work_(work) {}

    /// Makes the references of all candidates that are not done fine enough for their next rungs, of those that wait finer by
    /// a level, and of those without a next rung fine enough to be shown.
    void prepare(std::vector<Candidate>& candidates);
    /// Whether its error is too large for the budget, and a finer reference may have as many triangles as it needs.
    bool is_too_coarse(const Candidate& c) const noexcept;
    /// Whether it is the finest that fits.
    static bool is_limited_by_memory(const Candidate& c) noexcept;
    AssembledScene& scene() noexcept { return *scene_; }

private:
    void bake(Candidate& c);
    void build(std::vector<Candidate>& candidates);
    void try_build(std::vector<Candidate>& candidates);
    static bool coarsen(std::vector<Candidate>& candidates);
    void make_meters(Candidate& c);
    void measure(std::vector<Candidate>& candidates);

    PlanWork& work_;
    std::unique_ptr<AssembledScene> scene_;
};

} // namespace bake
