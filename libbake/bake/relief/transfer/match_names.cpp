#include "bake/relief/transfer/match_names.h"
#include "bake/base/error.h"
#include "bake/mesh/face_subset.h"
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

namespace bake {
namespace {

constexpr std::array<const char*, 4> ranks = {"low", "high", "lp", "hp"};

bool parts_words(char c) noexcept { return c == '_' || c == '-' || c == '.' || c == ' '; }

std::string part_name(const Mesh& mesh, std::size_t face, const std::string& path) {
    if (!mesh.face_group.empty() && mesh.face_group[face] != no_index) return mesh.groups[mesh.face_group[face]];
    if (!mesh.face_material.empty() && mesh.face_material[face] != no_index)
        return mesh.materials[mesh.face_material[face]];
    return std::filesystem::path(path).stem().string();
}

/// Faces by the name of their part.
std::map<std::string, std::vector<std::uint32_t>> faces_by_name(const Mesh& mesh, const std::string& path) {
    std::map<std::string, std::vector<std::uint32_t>> out;
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) out[part_name(mesh, f, path)].push_back(f);
    return out;
}

std::string listed(const std::set<std::string>& names) {
    constexpr std::size_t most = 4;
    std::string out;
    std::size_t count = 0;
    for (const std::string& name : names) {
        if (count++ == most) return out + ", ...";
        out += (out.empty() ? "" : ", ") + name;
    }
    return out;
}

} // namespace

std::string part_key(const std::string& name) {
    std::string key = name;
    for (char& c : key) c = char(std::tolower(static_cast<unsigned char>(c)));
    for (const std::string rank : ranks) {
        if (key == rank) return ""; // low.obj and high.ply
        if (key.size() <= rank.size() + 1) continue;
        if (key.starts_with(rank) && parts_words(key[rank.size()])) return key.substr(rank.size() + 1);
        if (key.ends_with(rank) && parts_words(key[key.size() - rank.size() - 1]))
            return key.substr(0, key.size() - rank.size() - 1);
    }
    return key;
}

NameMatch match_names(const Mesh& low, const std::string& path, std::vector<HighMesh> high) {
    const auto low_parts = faces_by_name(low, path);
    std::map<std::string, std::vector<HighMesh>> of_key;
    std::set<std::string> low_keys, low_names, high_names, alone;
    for (const auto& [name, faces] : low_parts) low_keys.insert(part_key(name)), low_names.insert(name);
    const auto key_of = [&](const std::string& name) {
        std::optional<std::string> best;
        const std::string key = part_key(name);
        for (const std::string& low_key : low_keys) // a key that goes on from another one comes after it
            if (key == low_key || (!low_key.empty() && key.starts_with(low_key + "_"))) best = low_key;
        return best;
    };
    for (const HighMesh& mesh : high)
        for (const auto& [name, faces] : faces_by_name(mesh.mesh, mesh.name)) {
            high_names.insert(name);
            const auto key = key_of(name);
            if (!key) alone.insert(name);
            else of_key[*key].push_back({face_subset(mesh.mesh, faces), mesh.name});
        }
    if (of_key.empty())
        throw Error(Refusal::unsuitable, path + ": no part has the name of a high-poly part (" + listed(low_names) +
                                             " against " + listed(high_names) +
                                             "); rename them, or bake without names");
    NameMatch out;
    out.of_face.assign(low.faces(), no_index);
    out.high_alone.assign(alone.begin(), alone.end());
    std::map<std::string, std::uint32_t> number;
    for (auto& [key, meshes] : of_key) {
        number[key] = std::uint32_t(out.names.size());
        out.names.push_back(key), out.high.push_back(std::move(meshes));
    }
    for (const auto& [name, faces] : low_parts) {
        const auto found = number.find(part_key(name));
        if (found == number.end()) out.low_alone.push_back(name);
        else
            for (const std::uint32_t f : faces) out.of_face[f] = found->second;
    }
    return out;
}

} // namespace bake
