// The texels of a planned texture.
#pragma once
#include "bake/verdict/plan/texture_plan.h"

namespace bake::test {

/// As they are read back, of the texture in full size.
inline Image<float> planned_texture(const SceneTexture& texture, const TexturePlan& plan) {
    const TextureForm form = form_of(plan);
    return stored(halvings_of(*texture.picture)[std::size_t(form.halvings)], texture.use, form);
}

} // namespace bake::test
