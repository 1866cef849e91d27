#include "bake/verdict/plan/planned_scene.h"
#include "bake/base/error.h"
#include "bake/preview/shape_mesh.h"
#include "bake/verdict/plan/folder_from.h"
#include "bake/verdict/plan/planned_parts.h"
#include "bake/verdict/plan/scene_text.h"
#include "bake/verdict/plan/toml_string.h"
#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <set>
#include <toml++/toml.h>

namespace bake {
namespace {

namespace fs = std::filesystem;

constexpr std::initializer_list<const char*> material_files = {
    "albedo",        "bump",         "normal",        "specular-map", "shininess-map",
    "roughness-map", "metallic-map", "occlusion-map", "emission-map", "height"};

/// A material as some of its meshes show it.
struct Version {
    std::string shade;        ///< name of the model
    MapForm map;              ///< of what is baked
    std::string name;         ///< of the material
    bool other_shade = false; ///< than the file has
};

const char* name_of(NormalDepth depth) noexcept {
    return depth == NormalDepth::bc5 ? " bc5" : depth == NormalDepth::floats ? " float" : "";
}

class Planner {
public:
    Planner(const std::string& text, const toml::table& root, const SceneEntries& entries, const ScenePlan& plan)
        : root_(root), entries_(entries), plan_(plan), edits_(text) {
        for (const char* list : {"mesh", "instance"})
            for (const toml::table* table : tables(root, list)) meshes_.push_back(table);
        for (const MaterialEntry& material : entries.materials) names_.insert(material.name);
        shown_.resize(entries.meshes.size());
    }

    void move_paths(const fs::path& folder);
    void reduce_files() { reduce_maps(edits_, root_, plan_); } ///< before set_methods(), which copies materials
    void set_methods();
    void set_parts();
    std::string text() const { return edits_.apply(); }

private:
    void move_path(const toml::node* node, const fs::path& folder);
    std::vector<Version> versions(int material);
    void set_version(TextEdits& edits, const toml::table& material, const Version& version) const;
    void add_copy(const toml::table& material, const Version& version, const TextEdits& moved);
    Span block_of_material(const toml::table& material) const;
    void refer_to_versions();
    std::string unused_name(const std::string& wanted);

    const toml::table& root_;
    const SceneEntries& entries_;
    const ScenePlan& plan_;
    TextEdits edits_;
    std::vector<const toml::table*> meshes_; ///< as SceneEntries::meshes
    std::vector<std::string> shown_;         ///< name of the material of each mesh; empty: as it was
    std::set<std::string> names_;            ///< of materials
};

void Planner::move_path(const toml::node* node, const fs::path& folder) {
    if (const toml::array* list = node ? node->as_array() : nullptr)
        for (const toml::node& one : *list) move_path(&one, folder);
    const auto* path = node ? node->as_string() : nullptr;
    if (!path) return;
    const std::string moved = (folder / path->get()).lexically_normal().generic_string();
    if (moved != path->get()) edits_.replace(span_of(edits_, *node), toml_string(moved));
}

void Planner::move_paths(const fs::path& folder) {
    for (const toml::table* mesh : tables(root_, "mesh")) {
        for (const char* key : {"file", "high"}) move_path(mesh->get(key), folder);
        const auto* shape = mesh->get_as<std::string>("shape");
        if (!shape) continue;
        const std::string moved = shape_beside((folder / "scene").string(), shape->get());
        if (moved != shape->get()) edits_.replace(span_of(edits_, *shape), toml_string(moved));
    }
    for (const toml::table* material : tables(root_, "material"))
        for (const char* key : material_files) {
            const toml::node* node = material->get(key);
            const toml::table* height = node ? node->as_table() : nullptr;
            move_path(height ? height->get("file") : node, folder);
        }
    if (const toml::table* sky = root_["sky"].as_table())
        for (const char* key : {"faces", "image", "irradiance", "specular"}) move_path(sky->get(key), folder);
}

std::string Planner::unused_name(const std::string& wanted) {
    std::string name = wanted;
    for (int number = 2; !names_.insert(name).second; ++number) name = wanted + " " + std::to_string(number);
    return name;
}

/// The models that the meshes of a material have, the one that keeps its name first. Notes the name for each mesh.
std::vector<Version> Planner::versions(int material) {
    const MaterialEntry& entry = entries_.materials[std::size_t(material)];
    std::vector<Version> list;
    if (entry.relief.file.empty()) return list;
    const std::string was = name(entry.relief.shade.value_or(ShadeMethod{}));
    const auto add = [&](const std::string& shade, const MapForm& map) -> Version& {
        for (Version& one : list)
            if (one.shade == shade && one.map == map) return one;
        const std::string wanted =
            entry.name + " " + shade + (map.size > 0 ? " " + std::to_string(map.size) : "") + name_of(map.depth);
        const std::string own = list.empty() ? entry.name : unused_name(wanted);
        return list.emplace_back(Version{shade, map, own, shade != was});
    };
    const auto shade_of = [&](std::size_t mesh) {
        const auto method = planned_method(plan_, int(mesh));
        return method ? name(*method) : was;
    };
    // What the plan has not decided stays as it is, under the name that it has.
    bool stays = entries_.ground && entries_.ground->material == material;
    for (std::size_t i = 0; i < entries_.meshes.size(); ++i)
        stays |= entries_.meshes[i].material == material && shade_of(i) == was && baked_form(plan_, int(i)).as_it_is();
    if (stays) add(was, {});
    for (std::size_t i = 0; i < entries_.meshes.size(); ++i)
        if (entries_.meshes[i].material == material) shown_[i] = add(shade_of(i), baked_form(plan_, int(i))).name;
    return list;
}

void Planner::set_version(TextEdits& edits, const toml::table& material, const Version& version) const {
    if (version.other_shade) set_material_key(edits, material, "shade", toml_string(version.shade));
    set_relief_form(edits, material, version.map);
}

/// The text of a material; refuses one with other tables within.
Span Planner::block_of_material(const toml::table& material) const {
    const Span span = block_of(edits_, material);
    if (material.is_inline()) return span;
    const auto within = [&](const toml::node& node) {
        const std::size_t at = span_of(edits_, node).begin;
        return &node != &material && at > span.begin && at < span.end;
    };
    for (auto&& [key, node] : root_) {
        bool split = node.is_table() && within(node);
        for (const toml::table* table : tables(root_, key.str())) split |= within(*table);
        if (split)
            throw Error(Refusal::unsuitable, entries_.file + ":" + std::to_string(material.source().begin.line) +
                                                 ": the keys of this material stand apart in the file, and a copy of "
                                                 "it is needed; write them behind one [[material]]");
    }
    return span;
}

/// Adds the material once more under another name, behind itself.
void Planner::add_copy(const toml::table& material, const Version& version, const TextEdits& moved) {
    const Span block = block_of_material(material);
    TextEdits copy = moved;
    copy.replace(span_of(copy, *material.get("name")), toml_string(version.name));
    set_version(copy, material, version);
    const std::string line = edits_.newline(block.end);
    edits_.insert(block.end, (material.is_inline() ? ", " : line + line) + copy.apply(block));
}

void Planner::refer_to_versions() {
    const auto named = [&](const std::string& mesh) {
        const auto is = [&](const MeshEntry& entry) { return entry.name == mesh; };
        return std::size_t(std::find_if(entries_.meshes.begin(), entries_.meshes.end(), is) - entries_.meshes.begin());
    };
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        if (shown_[i].empty()) continue;
        const toml::table& table = *meshes_[i];
        if (const auto* old = table.get_as<std::string>("material")) {
            if (old->get() != shown_[i]) edits_.replace(span_of(edits_, *old), toml_string(shown_[i]));
            continue;
        }
        // An instance has the material of its mesh, unless it names one.
        const auto* of = table.get_as<std::string>("mesh");
        if (of && shown_[named(of->get())] != shown_[i])
            add_key(edits_, table, *of, "material = " + toml_string(shown_[i]));
    }
}

void Planner::set_methods() {
    const std::vector<const toml::table*> materials = tables(root_, "material");
    const TextEdits moved = edits_;
    for (std::size_t m = 0; m < materials.size(); ++m) {
        const std::vector<Version> list = versions(int(m));
        for (const Version& version : list) {
            if (&version != list.data()) add_copy(*materials[m], version, moved);
            else set_version(edits_, *materials[m], version);
        }
    }
    refer_to_versions();
}

void Planner::set_parts() {
    set_high(edits_, meshes_, entries_, plan_);
    reduce_sky(edits_, root_, plan_);
    remove_lights(edits_, root_, entries_, plan_);
}

} // namespace

std::optional<ShadeMethod> planned_method(const ScenePlan& plan, int mesh) {
    for (const ObjectPlan& object : plan.objects)
        if (std::find(object.meshes.begin(), object.meshes.end(), mesh) != object.meshes.end())
            return object.chosen >= 0 ? object.rungs[std::size_t(object.chosen)].method : object.reference;
    return {};
}

std::string planned_scene(const std::string& text, const SceneEntries& entries, const ScenePlan& plan,
                          const std::string& out) {
    toml::table root;
    try {
        root = toml::parse(text, entries.file);
    } catch (const toml::parse_error& error) {
        throw Error(Refusal::unreadable, entries.file + ": " + std::string(error.description()));
    }
    if (tables(root, "material").size() != entries.materials.size() ||
        tables(root, "mesh").size() + tables(root, "instance").size() != entries.meshes.size())
        throw Error(Refusal::unreadable, entries.file + ": changed while it was planned; plan it again");
    Planner planner(text, root, entries, plan);
    if (const fs::path folder = folder_from(entries.file, out); folder != ".") planner.move_paths(folder);
    planner.reduce_files();
    planner.set_methods();
    planner.set_parts();
    return planner.text();
}

} // namespace bake
