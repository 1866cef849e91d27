// What a report asks of the rungs of an object.
#pragma once
#include "bake/verdict/plan/plan.h"
#include <string>

namespace bake {

/// Null: the reference.
inline const Rung* chosen_rung(const ObjectPlan& object) {
    return object.chosen >= 0 ? &object.rungs[std::size_t(object.chosen)] : nullptr;
}
/// The dearest rung below the chosen one.
inline const Rung* cheaper_rung(const ObjectPlan& object) {
    const int below = (object.chosen >= 0 ? object.chosen : int(object.rungs.size())) - 1;
    return below >= 0 ? &object.rungs[std::size_t(below)] : nullptr;
}
inline const Rung* dearer_rung(const ObjectPlan& object) {
    const std::size_t next = std::size_t(object.chosen) + 1;
    return object.chosen >= 0 && next < object.rungs.size() ? &object.rungs[next] : nullptr;
}
/// Whether probes have measured it.
inline bool has_error(const Rung& rung) { return rung.known == Known::probe || rung.known == Known::not_settled; }
/// "bound", "probe", "not-settled", "not-tried", "skipped".
const char* name(Known known) noexcept;

} // namespace bake
