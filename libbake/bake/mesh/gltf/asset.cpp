#include "bake/mesh/gltf/asset.h"
#include "bake/base/error.h"
#include "bake/base/version.h"
#include <algorithm>
#include <functional>
#include <map>

namespace bake {
namespace {

using json = nlohmann::ordered_json;

/// The number that `object` has under `key`, if it is one.
std::optional<std::size_t> number_at(const json& object, const char* key) {
    if (!object.is_object()) return {};
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number_unsigned()) return {};
    return found->get<std::size_t>();
}

/// Calls visit(object) for the value and every object in it.
void for_objects(const json& value, const std::function<void(const json&)>& visit) {
    if (value.is_object()) visit(value);
    if (value.is_structured())
        for (const json& inner : value) for_objects(inner, visit);
}

/// Numbers of the accessors that the JSON names, where the format and the extensions of nodes name them.
std::set<std::size_t> named_accessors(const json& root) {
    std::set<std::size_t> named;
    const auto take_all = [&](const json& map) {
        if (map.is_object())
            for (const json& index : map)
                if (index.is_number_unsigned()) named.insert(index.get<std::size_t>());
    };
    for_objects(root, [&](const json& object) {
        for (const char* key : {"indices", "inverseBindMatrices", "input", "output"})
            if (const auto index = number_at(object, key)) named.insert(*index);
        if (const auto attributes = object.find("attributes"); attributes != object.end()) take_all(*attributes);
        if (const auto targets = object.find("targets"); targets != object.end() && targets->is_array())
            for (const json& target : *targets) take_all(target);
    });
    return named;
}

std::set<std::size_t> named_views(const json& root) {
    std::set<std::size_t> named;
    for_objects(root, [&](const json& object) {
        if (const auto view = number_at(object, "bufferView")) named.insert(*view);
    });
    return named;
}

std::vector<std::size_t> descending(const std::set<std::size_t>& all, const std::set<std::size_t>& without) {
    std::vector<std::size_t> out;
    for (const std::size_t i : all)
        if (!without.contains(i)) out.push_back(i);
    std::reverse(out.begin(), out.end());
    return out;
}

void take_number(const json& object, const char* key, std::set<std::size_t>& to) {
    if (const auto index = number_at(object, key)) to.insert(*index);
}

/// The JSON with its keys in their order. Finding one takes as long as an object has keys: refuses more than any object of
/// the format has, which would take hours.
json parsed(const GltfDocument& document, const std::string& path) {
    constexpr std::size_t most_keys = 2000;
    std::vector<std::size_t> keys;
    const auto count = [&](int, json::parse_event_t event, json&) {
        if (event == json::parse_event_t::object_start) keys.push_back(0);
        if (event == json::parse_event_t::object_end) keys.pop_back();
        if (event == json::parse_event_t::key && ++keys.back() > most_keys)
            throw Error(Refusal::unsuitable, path + ": has an object of more than " + std::to_string(most_keys) +
                                                 " keys among its extras, which takes too long to copy; export it "
                                                 "without them");
        return true;
    };
    return json::parse(document.text.begin(), document.text.end(), count);
}

} // namespace

GltfAsset::GltfAsset(const GltfDocument& document, std::string path)
    : root(parsed(document, path)), document_(document), path_(std::move(path)) {}

json& GltfAsset::at(const char* list, std::size_t index) { return root[list][index]; }

void GltfAsset::set_image(std::size_t index, std::vector<std::uint8_t> png, const std::string& name) {
    json& image = at("images", index);
    take_number(image, "bufferView", old_views_);
    image = {{"name", gltf_text(name)}, {"mimeType", "image/png"}};
    images_.emplace_back(index, std::move(png));
}

void GltfAsset::patch(GltfPrimitivePatch patch) {
    const auto complete = [this](const GltfSharedValues& values) {
        if (!values || !values->like) return;
        json accessor = at("accessors", *values->like); // as it is in the file: nothing is replaced before write()
        for (const char* key : {"bufferView", "byteOffset", "sparse"}) accessor.erase(key);
        accessor.update(values->accessor);
        values->accessor = std::move(accessor);
        values->like.reset();
    };
    for (const auto& [semantic, values] : patch.attributes) complete(values);
    for (const auto& target : patch.targets)
        for (const auto& [semantic, values] : target) complete(values);
    patches_.push_back(std::move(patch));
}

void GltfAsset::take_out(GltfPrimitivePatch& patch) {
    json& primitive = at("meshes", patch.mesh)["primitives"][patch.primitive];
    const auto take = [&](json& map, const std::vector<std::pair<std::string, GltfSharedValues>>& values) {
        for (const auto& [semantic, accessor] : values) {
            take_number(map, semantic.c_str(), old_accessors_);
            if (accessor) map[semantic] = -1;
            else map.erase(semantic);
        }
    };
    take(primitive["attributes"], patch.attributes);
    for (std::size_t t = 0; t < patch.targets.size(); ++t) take(primitive["targets"][t], patch.targets[t]);
    if (patch.indices) {
        take_number(primitive, "indices", old_accessors_);
        primitive["indices"] = -1;
        primitive.erase("mode"); // a list of triangles
    }
    if (!patch.moved || !primitive.contains("extensions")) return;
    json& extensions = primitive["extensions"];
    if (const auto draco = extensions.find("KHR_draco_mesh_compression"); draco != extensions.end()) {
        take_number(*draco, "bufferView", old_views_);
        extensions.erase("KHR_draco_mesh_compression");
    }
    if (extensions.empty()) primitive.erase("extensions");
}

void GltfAsset::place_accessors() {
    for (GltfPrimitivePatch& patch : patches_) take_out(patch);
    std::vector<std::size_t> free = descending(old_accessors_, named_accessors(root));
    std::map<GltfValues*, std::size_t> placed;
    std::vector<GltfValues*> order;
    const auto place = [&](const GltfSharedValues& values, json& index) {
        const auto [found, added] = placed.try_emplace(values.get(), 0);
        if (added) {
            found->second = free.empty() ? root["accessors"].size() : free.back();
            json description = std::move(values->accessor);
            if (!free.empty()) {
                const json& old = at("accessors", free.back());
                take_number(old, "bufferView", old_views_);
                if (const auto sparse = old.find("sparse"); sparse != old.end())
                    for (const char* part : {"indices", "values"})
                        if (sparse->contains(part)) take_number((*sparse)[part], "bufferView", old_views_);
                free.pop_back();
            }
            at("accessors", found->second) = std::move(description);
            order.push_back(values.get());
        }
        index = found->second;
    };
    for (const GltfPrimitivePatch& patch : patches_) {
        json& primitive = at("meshes", patch.mesh)["primitives"][patch.primitive];
        for (const auto& [semantic, values] : patch.attributes)
            if (values) place(values, primitive["attributes"][semantic]);
        for (std::size_t t = 0; t < patch.targets.size(); ++t)
            for (const auto& [semantic, values] : patch.targets[t])
                if (values) place(values, primitive["targets"][t][semantic]);
        if (patch.indices) place(patch.indices, primitive["indices"]);
    }
    free_views_ = descending(old_views_, named_views(root));
    for (GltfValues* const values : order) {
        json extra = {{"target", values->indices ? 34963 : 34962}};
        if (values->stride > 0) extra["byteStride"] = values->stride;
        const std::size_t view = new_view(std::move(values->bytes), extra);
        at("accessors", placed[values])["bufferView"] = view;
    }
}

std::size_t GltfAsset::new_view(GltfBlock block, const json& extra) {
    json view = {{"buffer", document_.buffers.size() + added_.size()}, {"byteOffset", 0}, {"byteLength", block.bytes}};
    view.update(extra);
    added_.push_back(std::move(block));
    const std::size_t index = free_views_.empty() ? root["bufferViews"].size() : free_views_.back();
    if (!free_views_.empty()) free_views_.pop_back();
    at("bufferViews", index) = std::move(view);
    return index;
}

std::int64_t GltfAsset::write(const std::string& path, const Facts& facts, std::vector<std::string>& notes) {
    place_accessors();
    const std::vector<GltfBeside> beside = place_images(path, notes);
    const std::vector<GltfBlock> blocks = lay_out_buffer();
    sign();
    return write_gltf_files(path, root, blocks, beside, facts);
}

void GltfAsset::sign() {
    json& asset = root["asset"];
    const std::string ours = std::string("bake ") + version();
    const json before = asset.contains("generator") ? asset["generator"] : json();
    asset["generator"] = ours;
    if (!before.is_string() || before.get<std::string>().rfind("bake ", 0) == 0) return;
    if (!asset.contains("extras")) asset["extras"] = json::object();
    if (asset["extras"].is_object() && !asset["extras"].contains("generator")) asset["extras"]["generator"] = before;
}

} // namespace bake
