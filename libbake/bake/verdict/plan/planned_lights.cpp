// Lights that a plan leaves out.
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/verdict/plan/planned_parts.h"
#include "bake/verdict/plan/scene_text.h"
#include <algorithm>

namespace bake {
namespace {

/// The tables that SceneEntries::lights are read from; those of type "ambient" are a part of SceneEntries::ambient.
std::vector<const toml::table*> own_lights(const toml::table& root) {
    std::vector<const toml::table*> lights = tables(root, "light");
    std::erase_if(lights,
                  [](const toml::table* light) { return (*light)["type"].value_or(std::string()) == "ambient"; });
    return lights;
}

/// Whether the plan leaves out each light of the file; a scene has them before those of glTF files.
std::vector<bool> left_out(const SceneEntries& entries, const ScenePlan& plan) {
    std::vector<bool> out(entries.lights.size());
    for (const LightPlan& light : plan.lights)
        if (std::size_t(light.light) < out.size()) out[std::size_t(light.light)] = !light.keep;
    return out;
}

bool without_shadows(const ScenePlan& plan) {
    return std::any_of(plan.lights.begin(), plan.lights.end(), [](const LightPlan& light) { return !light.shadows; });
}

/// Three numbers, or one for all three, as the reader takes them; `value` if there is none.
Vec3f triple(const toml::table& table, std::string_view key, float value) {
    const toml::node* node = table.get(key);
    const toml::array* list = node ? node->as_array() : nullptr;
    Vec3f out(value);
    for (int c = 0; c < 3 && node; ++c)
        out[c] = float((list ? *list->get(std::size_t(c)) : *node).value_or(double(value)));
    return out;
}

/// The ambient light that a light gives besides its own.
Vec3f ambient_part(const toml::table& light) {
    return triple(light, "ambient", 0) * (triple(light, "colour", 1) * triple(light, "intensity", 1));
}

void make_ambient(TextEdits& edits, const toml::table& light, const Vec3f& colour) {
    const Span block = block_of(edits, light);
    const std::string type = "type = \"ambient\"",
                      value = format("colour = [%.9g, %.9g, %.9g]", colour.x, colour.y, colour.z);
    const std::string newline = edits.newline(block.begin);
    edits.replace(block,
                  light.is_inline() ? "{" + type + ", " + value + "}" : "[[light]]" + newline + type + newline + value);
}

} // namespace

void remove_lights(SceneEntries& entries, const ScenePlan& plan) {
    const std::vector<bool> out = left_out(entries, plan);
    std::vector<Light<float>> kept;
    for (std::size_t i = 0; i < out.size(); ++i)
        if (!out[i]) kept.push_back(entries.lights[i]);
    entries.lights = std::move(kept);
    if (without_shadows(plan)) entries.settings.shadows = false;
}

void remove_lights(TextEdits& edits, const toml::table& root, const SceneEntries& entries, const ScenePlan& plan) {
    const std::vector<bool> out = left_out(entries, plan);
    const std::vector<const toml::table*> lights = own_lights(root);
    if (lights.size() != out.size())
        throw Error(Refusal::unreadable, entries.file + ": changed while it was planned; plan it again");
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!out[i]) continue;
        const Vec3f ambient = ambient_part(*lights[i]);
        if (ambient == Vec3f(0)) remove_table(edits, *lights[i]);
        else make_ambient(edits, *lights[i], ambient);
    }
    if (without_shadows(plan) && entries.settings.shadows) set_key(edits, root, "render", "shadows", "false");
}

} // namespace bake
