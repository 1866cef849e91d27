#include "bake/mesh/smoothing_groups.h"
#include "bake/mesh/facet_normal.h"
#include <algorithm>
#include <numeric>

namespace bake {
namespace {

using Index = std::uint32_t;

/// Corners without a normal, sorted by position, then group.
std::vector<Index> bare_corners(const Mesh& mesh, const std::vector<Index>& face_of, const std::vector<Index>& group) {
    std::vector<Index> corners;
    for (Index c = 0; c < mesh.corners(); ++c)
        if (mesh.corner_normal[c] == no_index) corners.push_back(c);
    const auto key = [&](Index c) { return std::pair(mesh.corner_position[c], group[face_of[c]]); };
    std::stable_sort(corners.begin(), corners.end(), [&](Index a, Index b) { return key(a) < key(b); });
    return corners;
}

Index add_normal(Mesh& mesh, const Vec3d& sum) {
    const Vec3f n(unit_or_zero(sum));
    if (n == Vec3f(0)) return no_index;
    mesh.normals.push_back(n);
    return Index(mesh.normals.size() - 1);
}

} // namespace

void add_group_normals(Mesh& mesh, const std::vector<Index>& group) {
    std::vector<Index> face_of(mesh.corners());
    for (Index f = 0; f < mesh.faces(); ++f)
        std::fill(face_of.begin() + mesh.face_begin[f], face_of.begin() + mesh.face_begin[f + 1], f);
    const bool none = mesh.corner_normal.empty();
    if (none) mesh.corner_normal.assign(mesh.corners(), no_index);
    const std::vector<Index> corners = bare_corners(mesh, face_of, group);
    const auto group_of = [&](Index c) { return group[face_of[c]]; };
    const bool smooth = std::all_of(corners.begin(), corners.end(),
                                    [&](Index c) { return group_of(c) != 0 && group_of(c) == group_of(corners[0]); });
    if (smooth) {
        if (none) mesh.corner_normal.clear();
        return;
    }
    std::vector<Vec3d> at_corner(mesh.corners(), Vec3d(0)), of_face(mesh.faces(), Vec3d(0));
    for (const Triangle& t : triangulate(mesh)) {
        const auto at = [&](int k) { return Vec3d(mesh.positions[mesh.corner_position[t.corner[k]]]); };
        of_face[t.face] += glm::cross(at(1) - at(0), at(2) - at(0));
        for (Index k = 0; k < 3; ++k) at_corner[t.corner[k]] += angle_weighted_normal(mesh, t, k);
    }
    std::vector<Index> flat(mesh.faces(), no_index); // the normal of each flat face
    std::size_t flat_faces = 0;
    for (std::size_t i = 0, end; i < corners.size(); i = end) {
        const Index c = corners[i], g = group_of(c);
        end = i + 1;
        if (g == 0) {
            Index& normal = flat[face_of[c]];
            if (normal == no_index) normal = add_normal(mesh, of_face[face_of[c]]), ++flat_faces;
            mesh.corner_normal[c] = normal;
            continue;
        }
        Vec3d sum = at_corner[c];
        while (end < corners.size() && mesh.corner_position[corners[end]] == mesh.corner_position[c] &&
               group_of(corners[end]) == g)
            sum += at_corner[corners[end++]];
        const Index normal = add_normal(mesh, sum);
        for (std::size_t k = i; k < end; ++k) mesh.corner_normal[corners[k]] = normal;
    }
    mesh.notes.push_back("normals follow the smoothing groups of the file: " + std::to_string(flat_faces) + " of " +
                         std::to_string(mesh.faces()) + " faces are flat");
}

} // namespace bake
