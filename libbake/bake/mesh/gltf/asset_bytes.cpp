// The bytes of an asset that is written: one buffer of all that its views name, and its images.
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/base/text_line.h"
#include "bake/mesh/gltf/asset.h"
#include <algorithm>

namespace bake {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// What an object of the JSON says about the bytes of a buffer.
struct Named {
    json* object;
    std::size_t buffer, begin, end;
};

/// The bufferViews, and those of their extensions that name bytes of their own (compressed copies). Refuses bytes that the
/// buffers of the document do not have; a buffer without any bytes is one that a compressed copy stands in for.
std::vector<Named> named_bytes(json& root, std::span<const std::span<const std::uint8_t>> buffers,
                               const std::string& path) {
    std::vector<Named> out;
    const auto number = [&](const json& object, const char* key) {
        const auto found = object.find(key);
        if (found == object.end()) return std::size_t(0);
        if (!found->is_number_integer() || found->get<std::int64_t>() < 0)
            throw Error(Refusal::unreadable,
                        path + ": has a bufferView whose " + key + " is no number of bytes; export the file again");
        return found->get<std::size_t>();
    };
    const auto take = [&](json& object) {
        if (!object.is_object() || !object.contains("buffer") || !object["buffer"].is_number_unsigned()) return;
        const auto buffer = object["buffer"].get<std::size_t>();
        const std::size_t begin = number(object, "byteOffset"), length = number(object, "byteLength");
        const std::size_t size = buffer < buffers.size() ? buffers[buffer].size() : 0;
        if (size > 0 && (begin > size || length > size - begin))
            throw Error(Refusal::unreadable,
                        path + ": has a bufferView that ends behind its buffer; export the file again");
        out.push_back({&object, buffer, begin, begin + (size > 0 ? length : 0)});
    };
    if (!root.contains("bufferViews")) return out;
    for (json& view : root["bufferViews"]) {
        take(view);
        if (view.is_object() && view.contains("extensions"))
            for (json& extension : view["extensions"]) take(extension);
    }
    return out;
}

/// Bytes of one buffer of the document, and where they lie in the one that is written.
struct Range {
    std::size_t buffer, begin, end, at = 0;
};

/// What is named, in the order of the document; ranges that overlap or touch are one. They begin at multiples of four, so
/// that all values keep their alignment.
std::vector<Range> used_ranges(const std::vector<Named>& named,
                               std::span<const std::span<const std::uint8_t>> buffers) {
    std::vector<Range> all, out;
    for (const Named& n : named)
        if (n.buffer < buffers.size() && !buffers[n.buffer].empty()) all.push_back({n.buffer, n.begin / 4 * 4, n.end});
    std::sort(all.begin(), all.end(), [](const Range& a, const Range& b) {
        return std::pair(a.buffer, a.begin) < std::pair(b.buffer, b.begin);
    });
    for (const Range& range : all) {
        if (!out.empty() && out.back().buffer == range.buffer && range.begin <= (out.back().end + 3) / 4 * 4)
            out.back().end = std::max(out.back().end, range.end);
        else out.push_back(range);
    }
    return out;
}

/// The range that has the first of the bytes.
const Range* range_of(const std::vector<Range>& ranges, const Named& named) {
    const auto after =
        std::upper_bound(ranges.begin(), ranges.end(), std::pair(named.buffer, named.begin),
                         [](const auto& key, const Range& r) { return key < std::pair(r.buffer, r.begin); });
    return after == ranges.begin() ? nullptr : &*std::prev(after);
}

/// Whether objects outside of buffers and images name files, which stay where they are.
bool names_other_files(const json& value) {
    if (!value.is_structured()) return false;
    if (value.is_object() && value.contains("uri") && value["uri"].is_string() &&
        value["uri"].get<std::string>().rfind("data:", 0) != 0)
        return true;
    return std::any_of(value.begin(), value.end(), names_other_files);
}

} // namespace

std::vector<GltfBlock> GltfAsset::lay_out_buffer() {
    const std::vector<Named> named = named_bytes(root, document_.buffers, path_);
    std::vector<Range> ranges = used_ranges(named, document_.buffers);
    std::vector<GltfBlock> blocks;
    std::size_t bytes = 0;
    const auto add = [&](GltfBlock block) {
        const std::size_t at = bytes;
        bytes += block.padded();
        blocks.push_back(std::move(block));
        return at;
    };
    for (Range& range : ranges) {
        const auto from = document_.buffers[range.buffer].subspan(range.begin, range.end - range.begin);
        range.at = add({from.size(), [from](BlockWriter& out) { put(out, from); }});
    }
    std::vector<std::size_t> added_at;
    for (GltfBlock& block : added_) added_at.push_back(add(std::move(block)));
    for (const Named& n : named) {
        json& object = *n.object;
        std::size_t at = n.begin;
        if (n.buffer >= document_.buffers.size()) at = added_at.at(n.buffer - document_.buffers.size());
        else if (const Range* const range = range_of(ranges, n)) at = range->at + (n.begin - range->begin);
        object["buffer"] = 0;
        if (at != 0 || object.contains("byteOffset")) object["byteOffset"] = at;
    }
    if (root.contains("buffers") && root["buffers"].is_array() && root["buffers"].size() > 1)
        root["buffers"] = json::array({root["buffers"][0]});
    return blocks;
}

std::span<const std::uint8_t> GltfAsset::image(std::size_t index) const {
    for (const auto& [number, png] : images_)
        if (number == index) return png;
    return document_.images.at(index).bytes;
}

std::vector<GltfBeside> GltfAsset::place_images(const std::string& path, std::vector<std::string>& notes) {
    std::vector<GltfBeside> beside;
    if (!root.contains("images")) return beside;
    const bool binary = ending(path) == ".glb";
    std::error_code ignored;
    const fs::path from = fs::absolute(path_, ignored).parent_path(), to = fs::absolute(path, ignored).parent_path();
    const bool same_folder = fs::equivalent(from, to, ignored);
    const auto is_new = [&](std::size_t i) {
        return std::any_of(images_.begin(), images_.end(), [i](const auto& n) { return n.first == i; });
    };
    GltfNames names(path);
    for (std::size_t i = 0; !binary && same_folder && i < document_.images.size(); ++i)
        if (!is_new(i) && !document_.images[i].uri.empty()) names.next(document_.images[i].uri, i, "");
    for (std::size_t i = 0; i < root["images"].size(); ++i) {
        const bool fresh = is_new(i);
        json image = at("images", i);                   // a copy: a new key of the root moves all that is in it
        if (!fresh && !image.contains("uri")) continue; // in a view
        if (!fresh && !binary && document_.images[i].uri.empty()) continue; // a data URI
        if (!fresh && !binary && same_folder) continue;
        const auto bytes = this->image(i);
        if (bytes.empty()) {
            notes.push_back("its image " + shown(document_.images[i].uri) + " is missing, and stays so");
            continue;
        }
        if (binary) {
            image.erase("uri");
            if (const std::string type = gltf_mime_type(bytes); !type.empty()) image["mimeType"] = type;
            image["bufferView"] =
                new_view({bytes.size(), [bytes](BlockWriter& out) { put(out, bytes); }}, json::object());
        } else {
            const std::string wanted = fresh ? "" : fs::path(document_.images[i].uri).filename().string();
            image.erase("mimeType");
            const std::string name = names.next(wanted, i, ".png");
            image["uri"] = percent_encoded(name);
            beside.push_back({name, bytes});
        }
        at("images", i) = std::move(image);
    }
    bool others = false;
    for (const auto& [key, value] : root.items())
        others = others || (key != "buffers" && key != "images" && names_other_files(value));
    if (others && !same_folder) notes.push_back("an extension names files beside it, which are not copied");
    return beside;
}

} // namespace bake
