#include "bake/surface/patch/corner_attributes.h"
#include "bake/base/parallel.h"
#include "bake/surface/patch/tessellation.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace bake {
namespace {

/// Shares of the four corners of a quad, or of the three of a triangle.
std::array<double, 4> shares(const Vec2d& st, int sides) noexcept {
    if (sides == 3) return {1 - st.x - st.y, st.x, st.y, 0};
    return {(1 - st.x) * (1 - st.y), st.x * (1 - st.y), st.x * st.y, (1 - st.x) * st.y};
}

/// Shares of the corners of a face at a point of one of its patches: the `part`-th of `parts`.
void shares_of_face(const Vec2d& st, int sides, std::uint32_t corners, std::uint32_t part, std::uint32_t parts,
                    std::vector<double>& out) {
    out.assign(corners, 0);
    const std::array<double, 4> own = shares(st, sides);
    if (parts == 1 && std::uint32_t(sides) == corners) {
        for (std::uint32_t k = 0; k < corners; ++k) out[k] = own[k];
    } else if (parts == corners && sides == 4) {
        // A quad at a corner of the face, to the middle of the next edge, of the face, and of the edge before.
        const std::uint32_t next = (part + 1) % corners, before = (part + corners - 1) % corners;
        out[part] += own[0] + own[1] / 2 + own[3] / 2;
        out[next] += own[1] / 2, out[before] += own[3] / 2;
        for (double& share : out) share += own[2] / corners;
    } else {
        for (double& share : out) share = 1.0 / corners;
    }
}

/// Of each patch: its number among those of its face, and how many these are.
std::vector<std::pair<std::uint32_t, std::uint32_t>> parts_of_faces(const PatchComplex& complex) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> out(complex.patches.size());
    for (std::size_t first = 0, end; first < out.size(); first = end) {
        for (end = first; end < out.size() && complex.patches[end].face == complex.patches[first].face;) ++end;
        for (std::size_t p = first; p < end; ++p) out[p] = {std::uint32_t(p - first), std::uint32_t(end - first)};
    }
    return out;
}

/// Writes the faces of one cell again, into arrays of its own, with numbers of its points as uvs.
struct CellFaces {
    Mesh mesh;
    std::vector<Vec2d> st;
    CellRing numbers;
    RingBuilder builder;
    std::array<std::vector<FaceCorner>, 4> sides;

    std::size_t write(const PatchLayout& layout, std::uint32_t cell) {
        const PatchRates r = layout.of_cell(cell);
        st.clear();
        const std::uint32_t inside = numbers.number(
            *layout.cells, cell, r, [&](const Vec2d& in_patch, const Vec2d&) { st.push_back(in_patch); });
        const PatchRing real = builder.ring(layout, cell, r);
        PatchRing ring;
        for (int i = 0; i < r.sides; ++i) {
            sides[i].assign(real.side[i].begin(), real.side[i].end());
            for (std::size_t k = 0; k < sides[i].size(); ++k) sides[i][k].uv = numbers.ring.side[i][k].uv;
            ring.side[i] = sides[i];
        }
        const std::size_t corners = layout.corner_first[cell + 1] - layout.corner_first[cell];
        mesh.corner_position.resize(corners), mesh.corner_normal.resize(corners), mesh.corner_uv.resize(corners);
        mesh.face_begin.resize(layout.face_first[cell + 1] - layout.face_first[cell] + 1);
        FaceWriter writer(mesh, 0, 0);
        const std::uint32_t first = layout.inner_first[cell], end = first + inner_points(r);
        emit_faces(r, ring, first, writer);
        for (std::size_t c = 0; c < corners; ++c) // points inside have one number for all
            if (const std::uint32_t p = mesh.corner_position[c]; p >= first && p < end)
                mesh.corner_uv[c] = inside + (p - first);
        return corners;
    }
};

/// Gives corners of one vertex the values of the first of them, where they agree up to rounding.
void join(const Mesh& mesh, std::vector<Attribute>& attributes) {
    std::vector<std::uint32_t> head(mesh.positions.size(), no_index), next(mesh.corners(), no_index);
    const auto same = [&](std::uint32_t a, std::uint32_t b) {
        if (mesh.corner_normal[a] != mesh.corner_normal[b]) return false;
        if (!mesh.corner_uv.empty() && mesh.corner_uv[a] != mesh.corner_uv[b]) return false;
        for (const Attribute& attribute : attributes) {
            const auto width = std::size_t(attribute.components);
            for (std::size_t i = 0; i < width; ++i) {
                const float x = attribute.values[a * width + i], y = attribute.values[b * width + i];
                if (std::abs(x - y) > 1e-6f * (1 + std::abs(x))) return false;
            }
        }
        return true;
    };
    for (std::uint32_t c = 0; c < mesh.corners(); ++c) {
        std::uint32_t& first = head[mesh.corner_position[c]];
        std::uint32_t at = first;
        while (at != no_index && !same(at, c)) at = next[at];
        if (at == no_index) {
            next[c] = std::exchange(first, c);
            continue;
        }
        for (Attribute& attribute : attributes) {
            const auto width = std::size_t(attribute.components);
            std::copy_n(&attribute.values[at * width], width, &attribute.values[c * width]);
        }
    }
}

} // namespace

std::vector<Attribute> corner_attributes(const PatchLayout& layout, const Mesh& mesh) {
    const PatchCells& cells = *layout.cells;
    const Mesh& base = cells.base().mesh();
    const PatchComplex& patches = cells.base().complex();
    std::vector<Attribute> out;
    for (const Attribute& a : base.attributes)
        out.push_back({a.name, a.components, std::vector<float>(layout.corners * std::size_t(a.components))});
    if (out.empty()) return out;
    const auto parts = parts_of_faces(patches);
    for_rows(cells.count(), 64, [&](std::int64_t begin, std::int64_t end) {
        CellFaces faces;
        std::vector<double> share;
        for (auto cell = std::uint32_t(begin); cell < std::uint32_t(end); ++cell) {
            if (layout.corner_first[cell + 1] == layout.corner_first[cell]) continue;
            const std::size_t corners = faces.write(layout, cell);
            const std::uint32_t p = cells.patch(cell);
            const PatchComplex::Patch& patch = patches.patches[p];
            const std::uint32_t first = base.face_begin[patch.face], count = base.face_begin[patch.face + 1] - first;
            for (std::size_t c = 0; c < corners; ++c) {
                shares_of_face(faces.st[faces.mesh.corner_uv[c]], patch.sides(), count, parts[p].first, parts[p].second,
                               share);
                for (std::size_t a = 0; a < out.size(); ++a) {
                    const auto width = std::size_t(out[a].components);
                    for (std::size_t i = 0; i < width; ++i) {
                        double sum = 0;
                        for (std::uint32_t k = 0; k < count; ++k)
                            sum += share[k] * double(base.attributes[a].values[(first + k) * width + i]);
                        out[a].values[(layout.corner_first[cell] + c) * width + i] = float(sum);
                    }
                }
            }
        }
    });
    join(mesh, out);
    return out;
}

} // namespace bake
