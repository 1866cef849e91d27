// Decisions on several objects together.
//
// Each object was judged alone. Together they share the frame's budget (budget_shares.h), and then all planned models are
// probed against all references: over the pixels of each object, and over all pixels of the frame, where the shadow and the
// reflection of an object change those of others. Where a budget does not hold, the object with the largest share goes on
// to its next rung.
#pragma once
#include "bake/verdict/plan/plan_work.h"

namespace bake {

/// Lets objects take a cheaper rung that the frame can bear. Only for budgets of RMSE.
void share_frame(const PlanWork& work, std::span<ObjectDecision> decisions);

/// Probes all together and changes decisions until every budget holds. Nothing to do for an object that is alone.
void check_together(PlanWork& work, std::span<ObjectDecision> decisions);

inline constexpr double most_reference_triangles = 1.2e7; ///< of references in one scene
/// Decisions in groups whose references fit in memory together.
std::vector<std::vector<std::size_t>> reference_groups(std::span<const ObjectDecision> decisions);
/// The planned models of all, but of the group its references.
std::unique_ptr<AssembledScene> assemble_planned(PlanWork& work, std::span<const ObjectDecision> decisions,
                                                 std::span<const std::size_t> group = {});

} // namespace bake
