// What a plan decided on the parts of a scene that are no objects, in its entries and in the text of its file.
#pragma once
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/text_edits.h"
#include <span>
#include <toml++/toml.h>

namespace bake {

/// Leaves out the lights of the file that the plan leaves out, and shadows that it switches off. Lights of glTF files stay.
void remove_lights(SceneEntries& entries, const ScenePlan& plan);

/// The same in the text of the scene file. A light that is left out, and has an ambient part, becomes an ambient light. `root`
/// and `entries` are of that text. Throws Error{Refusal::unreadable} if they have other lights.
void remove_lights(TextEdits& edits, const toml::table& root, const SceneEntries& entries, const ScenePlan& plan);

/// What a plan makes of "normal-depth".
enum class NormalDepth {
    unchanged,
    bc5,
    floats, ///< of a map that was in BC5: the key, if there is one, is cleared
};

/// What a scene file says of a map: the values of "relief-size" or "albedo-size" and of "normal-depth".
struct MapForm {
    int size = 0; ///< most texels along an edge, if it is planned smaller than it is; else 0
    NormalDepth depth = NormalDepth::unchanged;
    bool as_it_is() const noexcept { return size == 0 && depth == NormalDepth::unchanged; }
    auto operator<=>(const MapForm&) const = default;
};
MapForm map_form(const TexturePlan& texture) noexcept;
/// The same of the map that is baked for a mesh.
MapForm baked_form(const ScenePlan& plan, int mesh) noexcept;
/// False for the map of a material that has no entry, as that of a glTF file.
bool scene_says_form(const TexturePlan& texture) noexcept;
/// Maps that files hold are read as planned.
void reduce_maps(SceneEntries& entries, const ScenePlan& plan);
void reduce_maps(TextEdits& edits, const toml::table& root, const ScenePlan& plan);
/// Sets the keys of a bump table or normal map that is not as it is.
void set_relief_form(MaterialEntry& material, const MapForm& form) noexcept;
void set_relief_form(TextEdits& edits, const toml::table& material, const MapForm& form);

/// Meshes with a high-poly mesh are shown by the model, and with the normal map, that was planned.
void set_high(SceneEntries& entries, const ScenePlan& plan);
/// `meshes`: the tables of SceneEntries::meshes.
void set_high(TextEdits& edits, std::span<const toml::table* const> meshes, const SceneEntries& entries,
              const ScenePlan& plan);

/// Shows the sky as planned, by the keys of `[sky]` that reduce it.
void reduce_sky(SceneEntries& entries, const ScenePlan& plan);
void reduce_sky(TextEdits& edits, const toml::table& root, const ScenePlan& plan);

} // namespace bake
