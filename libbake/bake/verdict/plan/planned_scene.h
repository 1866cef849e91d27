// A scene file in which each object is shown by the model that a plan chose.
#pragma once
#include "bake/verdict/plan/plan.h"
#include <string>

namespace bake {

/// The text of a scene file with `shade` set as the plan says, with the sky that it chose, and without
/// the lights and shadows that it leaves out. All else stays as it is, comments, order and spaces too. A
/// material whose meshes have different models is copied under a new name, to which the other meshes refer.
/// `text`: of the file that `entries` was read from. `out`: where the result will be written; if that is in another folder,
/// the relative paths in the text are changed so that they name the same files. Throws Error{Refusal::unreadable} if the
/// text is not TOML.
std::string planned_scene(const std::string& text, const SceneEntries& entries, const ScenePlan& plan,
                          const std::string& out);

/// What the plan decided and neither planned_scene() nor planned_entries() shows; each completes a sentence that begins with
/// the name of the planned scene.
std::vector<std::string> not_in_scene(const SceneEntries& entries, const ScenePlan& plan);

/// The model that a plan chose for a mesh; nothing where it has not decided.
std::optional<ShadeMethod> planned_method(const ScenePlan& plan, int mesh);

} // namespace bake
