#include "bake/surface/patch/tessellator.h"
#include "bake/base/pages.h"
#include "bake/base/parallel.h"

namespace bake {
namespace {

/// A part of the work on cells: all of the cells from `cell` to `cell_end`, or rows of a single large one.
struct CellJob {
    std::uint32_t cell, cell_end;
    std::uint32_t row = 0, row_end = 0; ///< 0, 0: whole cells
    bool whole() const noexcept { return row_end == 0; }
};

/// values.resize(count) in huge pages. resize_in_pages() would copy a value to each element, which takes longer than
/// clearing them.
template <class T> void size(std::vector<T>& values, std::size_t count) {
    values.reserve(count);
    use_huge_pages(values.data(), values.data() + count);
    values.resize(count);
}

Mesh make_arrays(const PatchLayout& layout, const Mesh& base) {
    Mesh mesh;
    // The system clears fresh memory slowly: each array is sized by whichever thread is free.
    for_rows(9, 1, [&](std::int64_t which, std::int64_t) {
        switch (which) {
        case 0: size(mesh.corner_position, layout.corners); break;
        case 1: size(mesh.corner_normal, layout.corners); break;
        case 2:
            if (layout.has_uv) size(mesh.corner_uv, layout.corners);
            break;
        case 3: size(mesh.positions, layout.points); break;
        case 4: size(mesh.normals, layout.normals); break;
        case 5: size(mesh.uvs, layout.uvs); break;
        case 6: size(mesh.face_begin, layout.faces + 1); break;
        case 7:
            if (!base.face_material.empty()) size(mesh.face_material, layout.faces);
            break;
        default:
            if (!base.face_group.empty()) size(mesh.face_group, layout.faces);
        }
    });
    mesh.materials = base.materials, mesh.groups = base.groups, mesh.origin = base.origin;
    return mesh;
}

// Faces.

std::vector<CellJob> face_jobs(const PatchLayout& layout) {
    constexpr std::uint64_t faces_per_job = 16384;
    const std::uint32_t cells = layout.cells->count();
    std::vector<CellJob> jobs;
    std::uint32_t first = 0;
    for (std::uint32_t c = 0; c < cells; ++c) {
        const std::uint64_t own = layout.face_first[c + 1] - layout.face_first[c];
        const PatchRates r = layout.of_cell(c);
        if (own >= 2 * faces_per_job && pattern(r) == PatchPattern::lattice && r.sides == 4 &&
            own == std::uint64_t(r.across) * r.up && layout.corner_first[c + 1] - layout.corner_first[c] == 4 * own) {
            if (c > first) jobs.push_back({first, c});
            const auto band = std::uint32_t(std::max<std::uint64_t>(1, faces_per_job / r.across));
            for (std::uint32_t row = 0; row < r.up; row += band)
                jobs.push_back({c, c + 1, row, std::min(r.up, row + band)});
            first = c + 1;
        } else if (layout.face_first[c + 1] - layout.face_first[first] >= faces_per_job || c - first >= 4096) {
            jobs.push_back({first, c + 1});
            first = c + 1;
        }
    }
    if (first < cells) jobs.push_back({first, cells});
    return jobs;
}

void write_faces(const PatchLayout& layout, Mesh& mesh) {
    const PatchComplex& complex = layout.cells->complex();
    const Mesh& base = layout.cells->base().mesh();
    const std::vector<CellJob> jobs = face_jobs(layout);
    mesh.face_begin[0] = 0;
    for_rows(std::int64_t(jobs.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        RingBuilder builder;
        for (auto i = begin; i < end; ++i)
            for (std::uint32_t c = jobs[i].cell; c < jobs[i].cell_end; ++c) {
                if (is_collapsed(complex.patches[c])) continue;
                const PatchRates r = layout.of_cell(c);
                const PatchRing ring = builder.ring(layout, c, r);
                const std::uint64_t skipped = std::uint64_t(jobs[i].row) * r.across;
                FaceWriter writer(mesh, layout.face_first[c] + skipped, layout.corner_first[c] + 4 * skipped);
                if (jobs[i].whole()) emit_faces(r, ring, layout.inner_first[c], writer);
                else emit_rows(r, ring, layout.inner_first[c], jobs[i].row, jobs[i].row_end, writer);
                const auto copy = [&](const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to) {
                    if (!from.empty())
                        std::fill(to.begin() + std::int64_t(layout.face_first[c] + skipped),
                                  to.begin() + std::int64_t(writer.faces()), from[complex.patches[c].face]);
                };
                copy(base.face_material, mesh.face_material);
                copy(base.face_group, mesh.face_group);
            }
    });
}

// Vertices.

std::vector<CellJob> vertex_jobs(const PatchLayout& layout) {
    constexpr std::uint32_t points_per_job = 4096;
    const std::uint32_t cells = layout.cells->count();
    std::vector<CellJob> jobs;
    std::uint64_t points = 0;
    std::uint32_t first = 0;
    for (std::uint32_t c = 0; c < cells; ++c) {
        const PatchRates r = layout.of_cell(c);
        const std::uint64_t own = 1 + 2 * (r.across + r.up) + std::uint64_t(inner_points(r));
        if (own > 2 * points_per_job) {
            if (c > first) jobs.push_back({first, c});
            first = c + 1, points = 0;
            const std::uint32_t rows = (r.sides == 4 ? r.up : r.across), band = std::max(1u, points_per_job / r.across);
            for (std::uint32_t row = 0; row < rows; row += band)
                jobs.push_back({c, c + 1, row, std::min(rows, row + band)});
            continue;
        }
        points += own;
        if (points >= points_per_job) {
            jobs.push_back({first, c + 1});
            first = c + 1, points = 0;
        }
    }
    if (first < cells) jobs.push_back({first, cells});
    return jobs;
}

/// Buffers of one thread, used again from cell to cell.
struct VertexBuffers {
    std::vector<Vec2d> st;
    std::vector<std::uint32_t> index;
    std::vector<SurfacePoint> points;
};

/// The vertices on the border of a cell that the cell owns and that belong to no junction.
void gather_border(const PatchLayout& layout, std::uint32_t cell, const PatchRates& r, VertexBuffers& b) {
    const PatchComplex::Patch& patch = layout.cells->complex().patches[cell];
    const auto& [edges, vertices] = layout.cells->junctions();
    for (int i = 0; i < r.sides; ++i) {
        const std::uint32_t me = 4 * cell + std::uint32_t(i), v = patch.vertex[i], e = patch.edge[i];
        if (layout.vertex_owner[v] == me && !vertices.find(v)) {
            b.st.push_back(layout.cells->on_side(cell, i, 0, 1));
            b.index.push_back(v);
        }
        const std::uint32_t rate = r.side[i];
        if (rate == 1 || layout.edge_owner[e] != me || is_point(patch, i) || edges.find(e)) continue;
        for (std::uint32_t k = 1; k < rate; ++k) {
            b.st.push_back(layout.cells->on_side(cell, i, k, rate));
            b.index.push_back(layout.edge_first[e] + (patch.reversed[i] ? rate - 1 - k : k - 1));
        }
    }
}

/// The vertices in rows [first, last) of a cell's inner lattice.
void gather_inside(const PatchLayout& layout, std::uint32_t cell, const PatchRates& r, std::uint32_t first,
                   std::uint32_t last, VertexBuffers& b) {
    if (inner_points(r) == 0) return;
    const std::uint32_t m = r.across, n = r.sides == 4 ? r.up : r.across;
    std::uint32_t index = layout.inner_first[cell];
    if (r.sides == 4) index += (first - 1) * (m - 1);
    else index += (first - 1) * (m - 1) - first * (first - 1) / 2;
    for (std::uint32_t j = first; j < last; ++j)
        for (std::uint32_t i = 1; i < (r.sides == 4 ? m : m - j); ++i) {
            b.st.push_back(layout.cells->at(cell, i, m, j, n));
            b.index.push_back(index++);
        }
}

void write_patches(const PatchLayout& layout, const CellJob& job, const VertexWriter& writer, Mesh& mesh,
                   std::size_t number) {
    thread_local VertexBuffers b;
    for (std::uint32_t cell = job.cell; cell < job.cell_end; ++cell) {
        const PatchRates r = layout.of_cell(cell);
        b.st.clear(), b.index.clear();
        if (job.whole() || job.row == 0) gather_border(layout, cell, r, b);
        const std::uint32_t last = !job.whole() ? job.row_end : r.sides == 4 ? r.up : r.across;
        if (!is_collapsed(layout.cells->complex().patches[cell]))
            gather_inside(layout, cell, r, std::max(1u, job.row), last, b);
        if (b.st.empty()) continue;
        b.points.resize(std::max(b.points.size(), b.st.size()));
        const std::span<SurfacePoint> points(b.points.data(), b.st.size());
        const std::uint32_t patch = layout.cells->patch(cell);
        layout.cells->base().evaluate(patch, b.st, points);
        writer.at_patch({patch, b.st, points, b.index}, mesh, number);
        for (std::size_t k = 0; k < points.size() && layout.has_uv; ++k) mesh.uvs[b.index[k]] = Vec2f(points[k].uv);
    }
}

/// Of the vertices of a junction: how many there are, and their indices.
struct JunctionIndices {
    std::uint32_t count, first, group_normals, group_uvs;
};

void write_junction(const PatchLayout& layout, const JunctionTable& table, const Junction& junction,
                    const JunctionIndices& indices, bool is_edge, const VertexWriter& writer, Mesh& mesh,
                    std::size_t number) {
    const PatchCells& cells = *layout.cells;
    const std::uint32_t count = indices.count, rate = count + 1;
    const std::span<const JunctionSide> sides = table.sides_of(junction);
    std::vector<Vec2d> st(sides.size() * count);
    std::vector<SurfacePoint> points(st.size());
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const JunctionSide& side = sides[k];
        for (std::uint32_t j = 0; j < count; ++j)
            st[k * count + j] =
                is_edge ? cells.on_side(side.patch, side.corner_or_side, side.reversed ? rate - 1 - j : j + 1, rate)
                        : cells.on_side(side.patch, side.corner_or_side, 0, 1);
        cells.base().evaluate(cells.patch(side.patch), {&st[k * count], count}, {&points[k * count], count});
    }
    writer.at_junction({junction, cells, sides, count, st, points, indices.first, indices.group_normals}, mesh, number);
    if (!layout.has_uv) return;
    for (std::size_t k = 0; k < sides.size(); ++k) {
        if (!first_of_groups(sides, k)) continue;
        const std::uint32_t g = sides[k].uv_group;
        for (std::uint32_t j = 0; j < count; ++j)
            mesh.uvs[g == 0 ? indices.first + j : indices.group_uvs + (g - 1) * count + j] =
                Vec2f(points[k * count + j].uv);
    }
}

/// The uvs of sides without length: one per segment, at its middle.
void write_pole_uvs(const PatchLayout& layout, std::uint32_t cell, Mesh& mesh) {
    const PatchComplex::Patch& patch = layout.cells->complex().patches[cell];
    for (int i = 0; i < patch.sides(); ++i) {
        if (!is_point(patch, i)) continue;
        const std::uint32_t rate = layout.of_cell(cell).side[i];
        for (std::uint32_t k = 0; k < rate; ++k) {
            const Vec2d st = layout.cells->on_side(cell, i, 2 * k + 1, 2 * rate);
            SurfacePoint point;
            layout.cells->base().evaluate(layout.cells->patch(cell), {&st, 1}, {&point, 1});
            mesh.uvs[layout.edge_first[patch.edge[i]] + k] = Vec2f(point.uv);
        }
    }
}

void write_vertices(const PatchLayout& layout, const VertexWriter& writer, Mesh& mesh, Progress* progress) {
    constexpr std::int64_t vertices_per_job = 256, edges_per_job = 16;
    const std::vector<CellJob> jobs = vertex_jobs(layout);
    const JunctionTable &edges = layout.cells->junctions().edges, &vertices = layout.cells->junctions().vertices;
    const auto patch_jobs = std::int64_t(jobs.size()), vertex_count = std::int64_t(vertices.junctions.size()),
               edge_count = std::int64_t(edges.junctions.size());
    const std::int64_t first_edge_job = patch_jobs + (vertex_count + vertices_per_job - 1) / vertices_per_job;
    const std::int64_t all_jobs = first_edge_job + (edge_count + edges_per_job - 1) / edges_per_job;
    if (writer.begin) writer.begin(std::size_t(all_jobs));
    for_rows(
        patch_jobs, 1,
        [&](std::int64_t i, std::int64_t) { write_patches(layout, jobs[i], writer, mesh, std::size_t(i)); }, progress);
    for_rows(
        vertex_count, vertices_per_job,
        [&](std::int64_t begin, std::int64_t end) {
            for (auto i = begin; i < end; ++i) {
                const Junction& j = vertices.junctions[i];
                write_junction(layout, vertices, j, {1, j.which, layout.vertex_normals[i], layout.vertex_uvs[i]}, false,
                               writer, mesh, std::size_t(patch_jobs + begin / vertices_per_job));
            }
        },
        progress);
    for_rows(
        edge_count, edges_per_job,
        [&](std::int64_t begin, std::int64_t end) {
            for (auto i = begin; i < end; ++i) {
                const Junction& j = edges.junctions[i];
                const std::uint32_t count = layout.rates->of_edge(j.which) - 1;
                if (count > 0)
                    write_junction(layout, edges, j,
                                   {count, layout.edge_first[j.which], layout.edge_normals[i], layout.edge_uvs[i]},
                                   true, writer, mesh, std::size_t(first_edge_job + begin / edges_per_job));
            }
        },
        progress);
    for_rows(layout.has_uv ? layout.cells->count() : 0, 4096, [&](std::int64_t begin, std::int64_t end) {
        for (auto c = begin; c < end; ++c) write_pole_uvs(layout, std::uint32_t(c), mesh);
    });
}

} // namespace

Mesh tessellate(const PatchLayout& layout, const VertexWriter& writer, Progress* progress) {
    Mesh mesh = make_arrays(layout, layout.cells->base().mesh());
    write_vertices(layout, writer, mesh, progress);
    write_faces(layout, mesh);
    return mesh;
}

} // namespace bake
