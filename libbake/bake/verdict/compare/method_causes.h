// The shares of a method's error by cause, for the methods of a compared scene.
#pragma once
#include "bake/verdict/compare/causes.h"
#include "bake/verdict/compare/compared_scene.h"

namespace bake {

/// The displacement that methods are compared with, and the same mesh without heights.
struct CauseReference {
    MethodScene displaced;
    Scene base;
};
/// `method` displaces by a number of segments, not by "max". Throws the errors of ComparedScene::load().
CauseReference load_cause_reference(const ComparedScene& scene, const ShadeMethod& method);

/// `shown` is scene.load(method). Settings are those of the scene. Throws the errors of cause_shares().
CauseShares method_causes(const ComparedScene& scene, const ShadeMethod& method, const MethodScene& shown,
                          const CauseReference& reference, float exposure, Progress* progress = nullptr);

} // namespace bake
