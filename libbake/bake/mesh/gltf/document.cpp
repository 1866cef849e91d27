#include "bake/mesh/gltf/document.h"
#include "bake/base/error.h"
#include "bake/base/memory.h"
#include "bake/base/progress.h"
#include "bake/base/provenance.h"
#include "bake/base/text_line.h"
#include "bake/mesh/gltf/extensions.h"
#include <bit>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace bake {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(Refusal::unreadable, path + ": " + why + "; copy or export the file again");
}

std::uint32_t little_endian(const char* p) noexcept {
    const auto byte = [p](int i) { return std::uint32_t(static_cast<unsigned char>(p[i])) << (8 * i); };
    return byte(0) | byte(1) | byte(2) | byte(3);
}

std::span<const std::uint8_t> bytes(const char* p, std::size_t size) noexcept {
    return {reinterpret_cast<const std::uint8_t*>(p), size};
}

struct Chunks {
    std::span<const std::uint8_t> json, binary;
    bool has_binary = false;
};

/// The two chunks of a .glb; further ones are skipped, as the format asks.
Chunks split_glb(const FileBytes& file, const std::string& path) {
    constexpr std::uint32_t json_type = 0x4e4f534a, binary_type = 0x004e4942;
    if (file.size < 20) refuse(path, "is cut short: " + std::to_string(file.size) + " bytes are no .glb");
    const std::uint32_t version = little_endian(file.begin() + 4), length = little_endian(file.begin() + 8);
    if (version != 2) refuse(path, "is a .glb of version " + std::to_string(version) + ", and not 2");
    if (length > file.size)
        refuse(path, "is cut short: it has " + std::to_string(file.size) + " of " + std::to_string(length) + " bytes");
    Chunks chunks;
    const char* p = file.begin() + 12;
    const char* const end = file.begin() + length;
    for (int chunk = 0; end - p >= 8; ++chunk) {
        const std::size_t size = little_endian(p);
        const std::uint32_t type = little_endian(p + 4);
        p += 8;
        if (size > std::size_t(end - p)) refuse(path, "has a chunk that reaches behind the end of the file");
        if (chunk == 0 && type != json_type) refuse(path, "does not begin with JSON");
        if (chunk == 0) chunks.json = bytes(p, size);
        if (chunk == 1 && type == binary_type) chunks.binary = bytes(p, size), chunks.has_binary = true;
        p += std::min((size + 3) / 4 * 4, std::size_t(end - p));
    }
    return chunks;
}

/// How deep lists and objects lie in each other.
int depth_of(std::span<const std::uint8_t> text) noexcept {
    int depth = 0, deepest = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::uint8_t c = text[i];
        if (c == '"') quoted = !quoted;
        else if (quoted) i += c == '\\' ? 1 : 0;
        else if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        else if (c == ']' || c == '}') --depth;
    }
    return deepest;
}

/// Bytes of a text, of which millions are parsed: Ctrl-C ends that.
class InterruptibleText {
public:
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;
    using iterator_category = std::forward_iterator_tag;

    explicit InterruptibleText(const std::uint8_t* p = nullptr) noexcept : p_(reinterpret_cast<const char*>(p)) {}
    reference operator*() const noexcept { return *p_; }
    InterruptibleText& operator++() {
        if ((reinterpret_cast<std::uintptr_t>(++p_) & 0xffff) == 0) throw_if_interrupted();
        return *this;
    }
    InterruptibleText operator++(int) {
        const InterruptibleText before = *this;
        ++*this;
        return before;
    }
    bool operator==(const InterruptibleText&) const noexcept = default;

private:
    const char* p_;
};

json parse(std::span<const std::uint8_t> text, const std::string& path) {
    // What reads the parsed JSON calls itself for every level. (The parser's own callback takes the square of the time.)
    constexpr int deepest = 64;
    if (depth_of(text) > deepest) refuse(path, "has JSON nested deeper than " + std::to_string(deepest));
    try {
        json parsed = json::parse(InterruptibleText(text.data()), InterruptibleText(text.data() + text.size()));
        if (!parsed.is_object()) refuse(path, "is not a glTF: its JSON is not an object");
        return parsed;
    } catch (const json::exception& error) {
        const std::string why = error.what(); // "[json.exception.parse_error.101] parse error at line 1, ..."
        refuse(path,
               "is not a glTF: " + shown(why.substr(why.find("] ") == std::string::npos ? 0 : why.find("] ") + 2)));
    }
}

/// The value of a digit of base64, or -1.
int base64_digit(char c) noexcept {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

/// False for anything that is not base64.
bool decode_base64(std::string_view text, std::vector<std::uint8_t>& out) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) return false;
    out.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) return false;
        bits = bits << 6 | std::uint32_t(digit);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        out.push_back(std::uint8_t(bits >> held));
    }
    return true;
}

bool is_data_uri(const std::string& uri) { return uri.rfind("data:", 0) == 0; }

/// data:MIME;base64,TEXT
std::vector<std::uint8_t> decode_data_uri(const std::string& uri, std::string& mime_type, const std::string& what,
                                          const std::string& path) {
    const std::size_t comma = uri.find(',');
    const std::string head = uri.substr(5, comma == std::string::npos ? 0 : comma - 5);
    std::vector<std::uint8_t> out;
    if (head.size() < 7 || head.compare(head.size() - 7, 7, ";base64") != 0 ||
        !decode_base64(std::string_view(uri).substr(comma + 1), out))
        refuse(path, what + " is not written in base64");
    mime_type = head.substr(0, head.find(';'));
    return out;
}

/// "%20" is a blank. Throws for what is no file beside the glTF.
std::string file_of_uri(const std::string& uri, const std::string& what, const std::string& path) {
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const auto hex = [&uri](std::size_t k) {
            return k < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[k])) != 0;
        };
        if (uri[i] == '%' && hex(i + 1) && hex(i + 2)) {
            name += char(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            name += uri[i];
        }
    }
    const bool control =
        std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
    if (name.empty() || control || name.find("://") != std::string::npos || std::filesystem::path(name).is_absolute())
        refuse(path, what + " is at " + shown(name) + ", which is no file beside it");
    return name;
}

std::string text_of(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// A buffer that meshoptimizer's extension declares as a fallback has no bytes: those of its views are compressed elsewhere.
void refuse_compressed_buffer(const json& object, const std::string& path) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) return;
    for (const auto& [name, content] : extensions->items())
        if (content.is_object() && content.value("fallback", json(false)) == json(true)) refuse_compression(name, path);
}

/// Extensions decide what a file means, so they are looked at before anything else is read.
void refuse_required_extensions(const json& root, const std::string& path) {
    const auto list = root.find("extensionsRequired");
    if (list == root.end()) return;
    if (!list->is_array()) refuse(path, "its extensionsRequired are not a list");
    std::vector<std::string> names;
    for (const json& name : *list) {
        if (!name.is_string()) refuse(path, "its extensionsRequired are not names");
        names.push_back(name.get<std::string>());
    }
    refuse_unknown_extensions(names, path);
}

/// Calls work(element) for each element of the list `key` of an object, if it has one.
template <class Work> void for_elements(const json& object, const char* key, Work&& work) {
    const auto list = object.is_object() ? object.find(key) : object.end();
    if (list != object.end() && list->is_array())
        for (const json& element : *list) work(element);
}

/// Draco replaces the attributes and indices of a primitive. A file that does not require Draco has them uncompressed too;
/// a file that has them in compressed form only names accessors without bytes.
void refuse_draco_alone(const json& root, const std::string& path) {
    const char* const draco = "KHR_draco_mesh_compression";
    std::vector<bool> has_bytes;
    for_elements(root, "accessors", [&](const json& accessor) {
        has_bytes.push_back(accessor.is_object() && (accessor.contains("bufferView") || accessor.contains("sparse")));
    });
    const auto check = [&](const json& index) {
        if (!index.is_number_unsigned() || index.get<std::size_t>() >= has_bytes.size()) return; // refused later
        if (!has_bytes[index.get<std::size_t>()]) refuse_compression(draco, path);
    };
    for_elements(root, "meshes", [&](const json& mesh) {
        for_elements(mesh, "primitives", [&](const json& primitive) {
            if (!primitive.is_object() || !primitive.value("extensions", json::object()).contains(draco)) return;
            for (const json& index : primitive.value("attributes", json::object())) check(index);
            check(primitive.value("indices", json()));
        });
    });
}

/// An empty object of three bytes becomes a struct of the model with many members.
void refuse_too_many_objects(const json& root, const std::string& path) {
    constexpr double material_bytes = 6000, other_bytes = 1500; // those of tinygltf and ours, roughly
    std::size_t objects = 0;
    double bytes = 0;
    for (const auto& [key, list] : root.items()) {
        if (!list.is_array()) continue;
        objects += list.size();
        bytes += double(list.size()) * (key == "materials" ? material_bytes : other_bytes);
    }
    for_elements(root, "meshes", [&](const json& mesh) {
        for_elements(mesh, "primitives", [&](const json&) { ++objects, bytes += other_bytes; });
    });
    refuse_unless_fits(path, "describes " + std::to_string(objects) + " nodes, meshes and other objects", bytes);
}

/// Many entries may name the same large file or view.
void add_bytes(GltfDocument& document, std::size_t bytes, const std::string& path) {
    const std::size_t before = document.bytes_beside;
    document.bytes_beside += bytes;
    if (before >> 26 == document.bytes_beside >> 26) return; // the limit is looked up once in 64 MiB
    refuse_unless_fits(path, "its buffers and images have " + std::to_string(document.bytes_beside) + " bytes",
                       double(document.bytes_beside));
}

void read_buffer(const json& object, std::size_t i, const Chunks& chunks, const std::string& path, GltfDocument& out) {
    const std::string what = "its buffer " + std::to_string(i);
    const auto length = object.is_object() ? object.find("byteLength") : object.end();
    if (!object.is_object() || length == object.end() || !length->is_number_unsigned())
        refuse(path, what + " has no byteLength");
    const std::string uri = text_of(object, "uri");
    std::span<const std::uint8_t> found;
    if (uri.empty()) refuse_compressed_buffer(object, path);
    if (uri.empty()) {
        if (i != 0 || !chunks.has_binary) refuse(path, what + " has neither a uri nor a binary chunk");
        found = chunks.binary;
    } else if (is_data_uri(uri)) {
        std::string ignored;
        out.decoded.push_back(decode_data_uri(uri, ignored, what, path));
        found = out.decoded.back();
    } else {
        const auto file = std::filesystem::path(path).parent_path() / file_of_uri(uri, what, path);
        out.beside.push_back(read_file(file.string()));
        found = bytes(out.beside.back().begin(), out.beside.back().size);
        add_bytes(out, found.size(), path);
    }
    if (length->get<std::uint64_t>() > found.size())
        refuse(path, what + " has " + std::to_string(found.size()) + " of " +
                         std::to_string(length->get<std::uint64_t>()) + " bytes");
    out.buffers.push_back(found.first(std::size_t(length->get<std::uint64_t>())));
}

void read_image(const json& object, std::size_t i, const std::string& path, GltfDocument& out) {
    const std::string what = "its image " + std::to_string(i);
    if (!object.is_object()) refuse(path, what + " is not described");
    GltfImage image{text_of(object, "name"), text_of(object, "mimeType"), {}, {}};
    std::int64_t view = -1;
    const std::string uri = text_of(object, "uri");
    if (const auto found = object.find("bufferView"); found != object.end() && found->is_number_unsigned()) {
        view = found->get<std::int64_t>();
        if (view < 0) view = INT64_MAX; // beyond any table
    } else if (is_data_uri(uri)) {
        image.bytes = decode_data_uri(uri, image.mime_type, what, path);
    } else if (!uri.empty()) {
        image.uri = file_of_uri(uri, what, path);
        try {
            const FileBytes file = read_file((std::filesystem::path(path).parent_path() / image.uri).string());
            image.bytes.assign(file.begin(), file.end());
        } catch (const Error& error) {
            if (error.refusal != Refusal::unreadable) throw; // a mesh is of use without its pictures
        }
    }
    add_bytes(out, image.bytes.size(), path);
    out.images.push_back(std::move(image));
    out.image_view.push_back(view);
}

} // namespace

void refuse_unless_fits(const std::string& path, const std::string& what, double bytes) {
    if (bytes > double(memory_limit().bytes))
        throw Error(Refusal::unsuitable, path + ": " + what + ", more than fit here; split the scene");
}

GltfDocument read_gltf_document(const std::string& path) {
    GltfDocument out;
    out.file = read_file(path);
    Chunks chunks;
    if (out.file.size >= 4 && std::memcmp(out.file.begin(), "glTF", 4) == 0) {
        chunks = split_glb(out.file, path);
    } else {
        chunks.json = bytes(out.file.begin(), out.file.size);
    }
    out.text = chunks.json;
    json parsed = parse(chunks.json, path);
    const auto asset = parsed.find("asset");
    const std::string version = asset != parsed.end() && asset->is_object() ? text_of(*asset, "version") : "";
    if (version.rfind("2.", 0) != 0)
        refuse(path,
               version.empty() ? "is not a glTF: it names no version" : "is glTF " + shown(version) + ", and not 2.0");
    if (asset->contains("extras") && (*asset)["extras"].is_object() && (*asset)["extras"].contains(record_key))
        out.record = valid_record((*asset)["extras"][record_key].dump());
    refuse_required_extensions(parsed, path);
    refuse_draco_alone(parsed, path);
    refuse_too_many_objects(parsed, path);
    const auto each = [&](const char* key, auto&& work) {
        const auto list = parsed.find(key);
        if (list == parsed.end()) return;
        if (!list->is_array()) refuse(path, std::string("its ") + key + " are not a list");
        out.decoded.reserve(out.decoded.size() + list->size()), out.beside.reserve(out.beside.size() + list->size());
        for (std::size_t i = 0; i < list->size(); ++i) work((*list)[i], i);
        parsed.erase(key);
    };
    each("buffers", [&](const json& object, std::size_t i) { read_buffer(object, i, chunks, path, out); });
    each("images", [&](const json& object, std::size_t i) { read_image(object, i, path, out); });
    for_elements(parsed, "materials", [&](const json&) { out.has_materials = true; });
    if (const auto cameras = parsed.find("cameras"); cameras != parsed.end()) out.cameras = cameras->dump();
    if (const json::json_pointer lights("/extensions/KHR_lights_punctual/lights"); parsed.contains(lights))
        out.lights = parsed[lights].dump();
    for (const char* unread : {"animations", "cameras", "extensions", "extras"}) parsed.erase(unread);
    out.json = parsed.dump();
    return out;
}

} // namespace bake
