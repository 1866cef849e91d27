// The sky as planned.
#include "bake/verdict/plan/planned_parts.h"
#include "bake/verdict/plan/scene_text.h"
#include "bake/verdict/plan/sky_plan.h"

namespace bake {
namespace {

/// Whether the plan has another sky than the scene.
bool reduces(const ScenePlan& plan) {
    return plan.sky && (plan.sky->model != "faces" || plan.sky->face < plan.sky->source_face);
}

} // namespace

void reduce_sky(SceneEntries& entries, const ScenePlan& plan) {
    if (!reduces(plan)) return;
    SkyReduction& own = entries.sky.reduction;
    const SkyReduction planned = reduction_of(*plan.sky);
    if (planned.sh_bands > 0) own.sh_bands = planned.sh_bands;
    // A series needs faces that are fine enough for it.
    if (planned.face_size > 0 || own.face_size > 0) own.face_size = plan.sky->face;
}

void reduce_sky(TextEdits& edits, const toml::table& root, const ScenePlan& plan) {
    if (!reduces(plan)) return;
    const SkyReduction planned = reduction_of(*plan.sky);
    if (planned.sh_bands > 0) set_key(edits, root, "sky", "sh-bands", std::to_string(planned.sh_bands));
    if (planned.face_size > 0 || root["sky"]["face-size"])
        set_key(edits, root, "sky", "face-size", std::to_string(plan.sky->face));
}

} // namespace bake
