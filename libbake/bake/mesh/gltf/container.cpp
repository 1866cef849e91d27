#include "bake/mesh/gltf/container.h"
#include "bake/base/content_hash.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include <algorithm>
#include <cstring>
#include <fstream>

namespace bake {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

void write_blocks(BlockWriter& out, std::span<const GltfBlock> blocks) {
    for (const GltfBlock& block : blocks) {
        block.write(out);
        out.write(std::string(block.padded() - block.bytes, '\0'));
    }
}

std::string little_endian(std::initializer_list<std::uint32_t> words) {
    std::string out(4 * words.size(), '\0');
    char* to = out.data();
    for (const std::uint32_t word : words) put_bytes(to, word);
    return out;
}

std::string text_of(const json& root, int indent) {
    return root.dump(indent, ' ', false, json::error_handler_t::replace);
}

std::int64_t write_glb(const std::string& path, const json& root, std::span<const GltfBlock> blocks,
                       std::size_t bytes) {
    std::string text = text_of(root, -1);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t length = 12 + 8 + text.size() + (bytes > 0 ? 8 + bytes : 0);
    if (length > 0xffffffffu)
        throw Error(Refusal::unsuitable,
                    path + ": not written, a .glb holds no more than 4 GiB; write a .gltf or a .ply");
    BlockWriter out(path);
    out.write("glTF" + little_endian({2, std::uint32_t(length), std::uint32_t(text.size()), 0x4e4f534a}));
    out.write(text);
    if (bytes > 0) out.write(little_endian({std::uint32_t(bytes), 0x004e4942}));
    write_blocks(out, blocks);
    out.commit();
    return out.bytes();
}

/// Whether a .gltf of this name is there and names the file as one of its images.
bool names_image(const std::string& path, const std::string& name) {
    std::ifstream in(path, std::ios::binary);
    const json root = in ? json::parse(in, nullptr, false) : json();
    if (!root.is_object() || !root.contains("images") || !root["images"].is_array()) return false;
    const auto names_it = [&](const json& image) {
        return image.is_object() && image.contains("uri") && image["uri"] == percent_encoded(name);
    };
    return std::any_of(root["images"].begin(), root["images"].end(), names_it);
}

/// The user chose the name of the .gltf alone: an image must not replace a file that has nothing to do with it.
void refuse_strangers(const std::string& path, std::span<const GltfBeside> beside) {
    for (const GltfBeside& file : beside) {
        const std::string target = (fs::path(path).parent_path() / file.name).string();
        std::error_code ignored;
        if (!fs::exists(target, ignored) || file_hash(target) == content_hash(file.bytes.data(), file.bytes.size()))
            continue;
        if (!names_image(path, file.name))
            throw Error(Refusal::usage, target + ": is there already, and an image of " +
                                            fs::path(path).filename().string() +
                                            " would replace it; choose another folder, or write a .glb");
    }
}

std::int64_t write_beside(const std::string& path, const json& root, std::span<const GltfBlock> blocks,
                          std::span<const GltfBeside> beside, std::size_t bytes) {
    refuse_strangers(path, beside);
    const fs::path folder = fs::path(path).parent_path();
    OutputSet together;
    std::int64_t all = 0;
    const auto write = [&](const std::string& file, const std::function<void(BlockWriter&)>& fill) {
        BlockWriter out(file);
        fill(out);
        out.commit();
        all += out.bytes();
    };
    if (bytes > 0)
        write((folder / (fs::path(path).stem().string() + ".bin")).string(),
              [&](BlockWriter& out) { write_blocks(out, blocks); });
    for (const GltfBeside& file : beside)
        write((folder / file.name).string(), [&](BlockWriter& out) { put(out, file.bytes); });
    write(path, [&](BlockWriter& out) { out.write(text_of(root, 1) + '\n'); });
    together.commit();
    return all;
}

/// The record of the run among the extras of the asset.
void sign(json& root, const std::string& record) {
    json& asset = root["asset"];
    if (record.empty() || (asset.contains("extras") && !asset["extras"].is_object())) return;
    asset["extras"][record_key] = json::parse(record);
}

} // namespace

GltfNames::GltfNames(const std::string& path)
    : stem_(fs::path(path).stem().string()), taken_{fs::path(path).filename().string(), stem_ + ".bin"} {}

std::string GltfNames::next(const std::string& wanted, std::size_t number, const std::string& ending) {
    std::string name = wanted.empty() ? stem_ + "_image" + std::to_string(number) + ending : wanted;
    while (!taken_.insert(name).second)
        name = fs::path(name).stem().string() + "_" + fs::path(name).extension().string();
    return name;
}

void put(BlockWriter& out, std::span<const std::uint8_t> bytes) {
    out.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string percent_encoded(const std::string& name) {
    std::string out;
    for (const char c : name) {
        const bool plain =
            (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || std::strchr("-._~", c);
        if (plain && c != 0) out += c;
        else {
            const auto code = static_cast<unsigned char>(c);
            out += {'%', "0123456789ABCDEF"[code >> 4], "0123456789ABCDEF"[code & 15]};
        }
    }
    return out;
}

std::string gltf_text(const std::string& text) { return json::parse(text_of(json(text), -1)).get<std::string>(); }

std::string gltf_mime_type(std::span<const std::uint8_t> bytes) {
    const auto has = [bytes](std::size_t at, std::string_view text) {
        return bytes.size() > at + text.size() && std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
    };
    if (has(0, "\x89PNG\r\n\x1a\n")) return "image/png";
    if (has(0, "\xff\xd8\xff")) return "image/jpeg";
    if (has(0, "RIFF") && has(8, "WEBP")) return "image/webp";
    if (has(0, "\xabKTX 20\xbb")) return "image/ktx2";
    if (has(0, "DDS ")) return "image/vnd-ms.dds";
    return has(4, "ftypavif") ? "image/avif" : "";
}

std::int64_t write_gltf_files(const std::string& path, json& root, std::span<const GltfBlock> blocks,
                              std::span<const GltfBeside> beside, const Facts& facts) {
    sign(root, record_text(facts));
    std::size_t bytes = 0;
    for (const GltfBlock& block : blocks) bytes += block.padded();
    if (bytes == 0) {
        root.erase("buffers");
    } else {
        if (!root.contains("buffers") || !root["buffers"].is_array() || root["buffers"].empty())
            root["buffers"] = json::array({json::object()});
        json& buffer = root["buffers"][0];
        buffer["byteLength"] = bytes;
        buffer.erase("uri");
        if (ending(path) != ".glb") buffer["uri"] = percent_encoded(fs::path(path).stem().string() + ".bin");
    }
    return ending(path) == ".glb" ? write_glb(path, root, blocks, bytes)
                                  : write_beside(path, root, blocks, beside, bytes);
}

} // namespace bake
