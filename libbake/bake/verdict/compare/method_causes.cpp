#include "bake/verdict/compare/method_causes.h"

namespace bake {

CauseReference load_cause_reference(const ComparedScene& scene, const ShadeMethod& method) {
    return {scene.load(method), scene.load_base(method)};
}

CauseShares method_causes(const ComparedScene& scene, const ShadeMethod& method, const MethodScene& shown,
                          const CauseReference& reference, float exposure, Progress* progress) {
    const bool displaces = method.shade == Shade::displace || method.shade == Shade::displace_normal;
    std::optional<Scene> base;
    if (displaces) base.emplace(scene.load_base(method));
    const CauseScenes scenes{&shown.scene, &reference.displaced.scene, base ? &*base : nullptr, &reference.base,
                             reference.displaced.of_object};
    return cause_shares(scenes, {.settings = scene.settings(), .exposure = exposure}, progress);
}

} // namespace bake
