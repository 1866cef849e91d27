#include "bake/mesh/uv_set.h"
#include "bake/base/error.h"
#include "bake/mesh/distinct_corners.h"
#include "bake/mesh/mesh_corner.h"
#include "bake/mesh/number_distinct.h"
#include <map>

namespace bake {
namespace {

const char* const set_name = "TEXCOORD_";

template <class AnyMesh> auto* uv_attribute(AnyMesh& mesh, int set) {
    decltype(mesh.attributes.data()) found = nullptr;
    for (auto& a : mesh.attributes)
        if (a.components == 2 && a.name == set_name + std::to_string(set)) found = &a;
    return found;
}

} // namespace

bool has_uv_set(const Mesh& mesh, int set) {
    return set == 0 ? !mesh.corner_uv.empty() : uv_attribute(mesh, set) != nullptr;
}

std::string uv_set_names(const Mesh& mesh) {
    std::string out = has_uv_set(mesh, 0) ? "0" : "";
    for (const Attribute& a : mesh.attributes)
        if (a.components == 2 && a.name.rfind(set_name, 0) == 0)
            out += (out.empty() ? "" : ", ") + a.name.substr(std::string(set_name).size());
    return out.empty() ? "none" : out;
}

CornerUvs exchange_uv_sets(Mesh& mesh, const std::vector<int>& face_set) {
    CornerUvs out{std::vector<Vec2f>(mesh.corners()), std::vector<bool>(mesh.corners())};
    std::map<int, Attribute*> sets;
    for (const int set : face_set)
        if (set != 0 && !sets.count(set)) sets[set] = uv_attribute(mesh, set);
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
        for (std::uint32_t c = begin; c < end; ++c) {
            out.uv[c] = uv_at(mesh, c);
            out.has[c] = !mesh.corner_uv.empty() && mesh.corner_uv[c] != no_index;
        }
        if (face_set[f] == 0) continue;
        bool any = false;
        for (std::uint32_t c = begin; c < end; ++c) {
            float* const other = &sets[face_set[f]]->values[2 * std::size_t(c)];
            std::swap(other[0], out.uv[c].x), std::swap(other[1], out.uv[c].y);
            any = any || out.uv[c] != Vec2f(0);
        }
        std::fill(out.has.begin() + begin, out.has.begin() + end, any);
    }
    return out;
}

void set_corner_uvs(Mesh& mesh, const CornerUvs& corners) {
    const DistinctCorners distinct = distinct_corners(
        mesh.corners(), mesh.positions.size(), [&](std::uint32_t c) { return mesh.corner_position[c]; },
        [&](std::uint32_t c) { return float_bits(corners.uv[c].x, corners.uv[c].y); },
        [&](std::uint32_t a, std::uint32_t b) {
            return corners.has[a] == corners.has[b] && (!corners.has[a] || corners.uv[a] == corners.uv[b]);
        });
    mesh.uvs.clear();
    std::vector<std::uint32_t> index(distinct.first.size(), no_index); // of the numbers that have a uv
    for (std::size_t i = 0; i < distinct.first.size(); ++i) {
        if (!corners.has[distinct.first[i]]) continue;
        index[i] = std::uint32_t(mesh.uvs.size());
        mesh.uvs.push_back(corners.uv[distinct.first[i]]);
    }
    mesh.corner_uv.clear();
    if (mesh.uvs.empty()) return;
    mesh.corner_uv.resize(mesh.corners());
    for (std::size_t c = 0; c < mesh.corners(); ++c) mesh.corner_uv[c] = index[distinct.corner[c]];
}

void take_uv_set(Mesh& mesh, int set, const std::string& path) {
    if (!has_uv_set(mesh, set))
        throw Error(Refusal::unsuitable, path + ": has no uvs of set " + std::to_string(set) +
                                             "; its sets are: " + uv_set_names(mesh) + " (`uv_set`)");
    if (set != 0) set_corner_uvs(mesh, exchange_uv_sets(mesh, std::vector<int>(mesh.faces(), set)));
}

} // namespace bake
