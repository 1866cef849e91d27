// The shares of many methods' errors, against one reference.
#pragma once
#include "bake/verdict/compare/causes.h"
#include "bake/verdict/compare/compared_scene.h"

namespace bake {

/// Builds the scene of the reference once.
class CauseJudge {
public:
    /// `reference` displaces. `object_pixels` of the picture show the object: about 2000 of them are rendered. `scene` must
    /// outlive it. Throws the errors of ComparedScene::load().
    CauseJudge(const ComparedScene& scene, const ShadeMethod& reference, float exposure, std::int64_t object_pixels);

    /// Throws the errors of cause_shares() and of ComparedScene::load().
    CauseShares shares(const ShadeMethod& method, Progress* progress = nullptr) const;

private:
    const ComparedScene& scene_;
    MethodScene reference_;
    Scene reference_base_;
    CauseOptions options_;
};

} // namespace bake
