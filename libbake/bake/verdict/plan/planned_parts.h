// What a plan decided on the parts of a scene that are no objects, in its entries and in the text of its file.
#pragma once
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/text_edits.h"
#include <toml++/toml.h>

namespace bake {

/// Leaves out the lights of the file that the plan leaves out, and shadows that it switches off. Lights of glTF files stay.
void remove_lights(SceneEntries& entries, const ScenePlan& plan);

/// The same in the text of the scene file. A light that is left out, and has an ambient part, becomes an ambient light. `root`
/// and `entries` are of that text. Throws Error{Refusal::unreadable} if they have other lights.
void remove_lights(TextEdits& edits, const toml::table& root, const SceneEntries& entries, const ScenePlan& plan);

/// Most texels along an edge of a texture that is planned smaller than it is; else 0.
int size_limit(const TexturePlan& texture) noexcept;
/// The same of the map that is baked for a mesh.
int baked_limit(const ScenePlan& plan, int mesh) noexcept;
/// Maps that files hold are read as small as planned.
void reduce_maps(SceneEntries& entries, const ScenePlan& plan);
void reduce_maps(TextEdits& edits, const toml::table& root, const ScenePlan& plan);

/// Shows the sky as planned, by the keys of `[sky]` that reduce it.
void reduce_sky(SceneEntries& entries, const ScenePlan& plan);
void reduce_sky(TextEdits& edits, const toml::table& root, const ScenePlan& plan);

} // namespace bake
