#include "bake/surface/patch/surface_mesh.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/mesh/keep_used.h"
#include "bake/surface/chart/tangent_space.h"
#include "bake/surface/patch/corner_attributes.h"
#include "bake/surface/patch/tessellator.h"
#include "bake/surface/point/curvature.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace bake {

SurfaceValues surface_values(const SurfacePoint& point, bool has_uv) noexcept {
    const Jet<double>& jet = point.jet;
    SurfaceValues out{.p = jet.p, .n = jet.n};
    if (jet.sigma == 0) {
        out.degenerate = jet.n == Vec3d(0) ? Degenerate::without_normal : Degenerate::pole;
        return out;
    }
    const Curvature<double> c = curvature(jet);
    out.mean_curvature = c.mean, out.gauss_curvature = c.gauss;
    if (!has_uv) return out;
    const Vec2d uv_s = point.uv_s, uv_t = point.uv_t;
    const double area = uv_s.x * uv_t.y - uv_t.x * uv_s.y, noise = 1e-12 * glm::length(uv_s) * glm::length(uv_t);
    if (!(std::abs(area) > noise)) {
        out.degenerate = Degenerate::no_chart;
        return out;
    }
    out.p_u = (uv_t.y * jet.p_u - uv_s.y * jet.p_v) / area;
    out.p_v = (uv_s.x * jet.p_v - uv_t.x * jet.p_u) / area;
    out.sigma = area > 0 ? jet.sigma : -jet.sigma;
    return out;
}

namespace {

SurfaceSample sample_at(const BaseSurface& surface, std::uint32_t patch, const Vec2d& st,
                        const SurfacePoint& point) noexcept {
    const bool has_uv = !surface.mesh().corner_uv.empty();
    SurfaceValues values = surface_values(point, has_uv);
    const SurfaceSample sample{Vec3f(values.n),
                               float(glm::length(values.p_u)),
                               float(glm::length(values.p_v)),
                               float(values.mean_curvature),
                               float(values.gauss_curvature),
                               values.degenerate};
    if (point.curved && (values.degenerate == Degenerate::none || values.degenerate == Degenerate::no_chart))
        return sample;
    const bool quad = surface.complex().patches[patch].sides() == 4;
    const Vec2d middle(quad ? 0.5 : 1 / 3.0), inside = st + (middle - st) / 1024.0;
    SurfacePoint near;
    surface.evaluate(patch, {&inside, 1}, {&near, 1});
    values = surface_values(near, has_uv);
    SurfaceSample out = sample;
    if (out.n == Vec3f(0)) out.n = Vec3f(values.n);
    out.mean = float(values.mean_curvature), out.gauss = float(values.gauss_curvature);
    return out;
}

/// The place of every triangle of a mesh or a shape, and of every corner in the first triangle that has it. Quads are one
/// patch, other polygons one per triangle, in the order of the faces.
std::vector<std::pair<std::uint32_t, Vec2d>> place_triangles(SurfaceMesh& out) {
    const Mesh& mesh = out.mesh;
    std::vector<std::pair<std::uint32_t, Vec2d>> corner_place(mesh.corners(), {no_index, Vec2d(0)});
    std::uint32_t patch = 0;
    for (std::size_t t = 0; t < out.triangles.size(); ++t) {
        const Triangle& triangle = out.triangles[t];
        const std::uint32_t first = mesh.face_begin[triangle.face];
        const bool quad = mesh.face_begin[triangle.face + 1] - first == 4;
        TrianglePlace& here = out.places.emplace_back();
        here.patch = patch;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t c = triangle.corner[k];
            here.st[k] = quad ? quad_corners[c - first] : triangle_corners[k];
            if (corner_place[c].first == no_index) corner_place[c] = {patch, here.st[k]};
        }
        const bool second_half = quad && t > 0 && out.triangles[t - 1].face == triangle.face;
        patch += !quad || second_half;
    }
    return corner_place;
}

/// One normal per position and value, in order of first use.
void number_normals(SurfaceMesh& out) {
    Mesh& mesh = out.mesh;
    mesh.normals.clear();
    mesh.corner_normal.resize(mesh.corners());
    // Lists of the normals at one position: the last one, and the one before each.
    std::vector<std::uint32_t> last(mesh.positions.size(), no_index), before;
    for (std::uint32_t c = 0; c < mesh.corners(); ++c) {
        const Vec3f& n = out.samples[c].n;
        std::uint32_t& head = last[mesh.corner_position[c]];
        std::uint32_t at = head;
        while (at != no_index && mesh.normals[at] != n) at = before[at];
        if (at == no_index) {
            at = std::uint32_t(mesh.normals.size());
            mesh.normals.push_back(n);
            before.push_back(std::exchange(head, at));
        }
        mesh.corner_normal[c] = at;
    }
}

/// Meshes and shapes keep their own faces.
void keep_faces(const BaseSurface& surface, SurfaceMesh& out) {
    out.mesh = surface.mesh();
    out.triangles = triangulate(out.mesh);
    const auto corner_place = place_triangles(out);
    out.samples.resize(out.mesh.corners());
    out.corner_sample.resize(out.mesh.corners());
    for_rows(std::int64_t(out.mesh.corners()), 1024, [&](std::int64_t begin, std::int64_t end) {
        for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
            const auto& [patch, st] = corner_place[c];
            SurfacePoint point;
            surface.evaluate(patch, {&st, 1}, {&point, 1});
            out.samples[c] = sample_at(surface, patch, st, point);
            out.corner_sample[c] = std::uint32_t(c);
        }
    });
    if (out.kind != SurfaceKind::mesh) return; // a shape's mesh has exact normals
    keep_used(out.mesh.positions, out.mesh.corner_position);
    number_normals(out);
}

/// Samples at the lattice of every patch, and which of them each corner and triangle shows.
void sample_patches(const BaseSurface& surface, const PatchLayout& layout, SurfaceMesh& out, Progress* progress) {
    const PatchCells& cells = *layout.cells;
    std::vector<std::uint32_t> first{0}; // sample of each patch
    for (std::uint32_t p = 0; p < cells.count(); ++p) {
        const PatchRates r = layout.of_cell(p);
        first.push_back(first.back() + std::uint32_t(r.sides) * r.across + inner_points(r));
    }
    std::vector<Vec2d> st(first.back());
    out.samples.resize(first.back());
    out.corner_sample.resize(layout.corners);
    for_rows(
        cells.count(), 4,
        [&](std::int64_t begin, std::int64_t end) {
            CellRing ring;
            std::vector<SurfacePoint> points;
            for (auto p = std::uint32_t(begin); p < std::uint32_t(end); ++p) {
                const PatchRates r = layout.of_cell(p);
                const std::span<Vec2d> here(&st[first[p]], first[p + 1] - first[p]);
                std::size_t filled = 0;
                const std::uint32_t inside =
                    ring.number(cells, p, r, [&](const Vec2d& in_patch, const Vec2d&) { here[filled++] = in_patch; });
                points.resize(here.size());
                surface.evaluate(p, here, points);
                for (std::size_t k = 0; k < here.size(); ++k)
                    out.samples[first[p] + k] = sample_at(surface, p, here[k], points[k]);
                std::uint32_t* corner = &out.corner_sample[layout.corner_first[p]];
                FaceVisitor visitor([&](std::span<const std::uint32_t> face) {
                    for (const std::uint32_t k : face) *corner++ = first[p] + k;
                });
                emit_faces(r, ring.ring, inside, visitor);
            }
        },
        progress);
    out.places.resize(out.triangles.size());
    const std::size_t faces_per_patch = out.mesh.faces() / cells.count();
    for_rows(std::int64_t(out.triangles.size()), 16384, [&](std::int64_t begin, std::int64_t end) {
        for (auto t = std::size_t(begin); t < std::size_t(end); ++t) {
            out.places[t].patch = std::uint32_t(out.triangles[t].face / faces_per_patch);
            for (std::size_t k = 0; k < 3; ++k) out.places[t].st[k] = st[out.corner_sample[out.triangles[t].corner[k]]];
        }
    });
}

/// Where the surface has no normal (the tip of a spike), each corner shows that of its own patch.
void add_missing_normals(SurfaceMesh& out) {
    Mesh& mesh = out.mesh;
    bool any = false;
    for (std::size_t c = 0; c < mesh.corners(); ++c) {
        if (mesh.normals[mesh.corner_normal[c]] != Vec3f(0)) continue;
        any = true;
        mesh.corner_normal[c] = std::uint32_t(mesh.normals.size());
        mesh.normals.push_back(out.samples[out.corner_sample[c]].n);
    }
    if (any) keep_used(mesh.normals, mesh.corner_normal);
}

/// rate x rate quads or rate^2 triangles of every patch.
void tessellate_limit(const BaseSurface& surface, int rate, SurfaceMesh& out, Progress* progress) {
    const PatchCells cells(surface, 1);
    const CellRates rates{.uniform = std::uint32_t(rate)};
    const PatchLayout layout = make_layout(cells, rates, !surface.mesh().corner_uv.empty());
    if (std::max(layout.corners, layout.points + 4 * std::uint64_t(rate) * cells.count()) >= no_index)
        throw Error{Refusal::unsuitable, "the limit surface: " + std::to_string(cells.count()) + " patches of " +
                                             std::to_string(rate) + " x " + std::to_string(rate) +
                                             " cells are more than a mesh can have; take a lower `rate`"};
    const VertexWriter writer{.at_patch =
                                  [](const PatchVertices& v, Mesh& mesh, std::size_t) {
                                      for (std::size_t k = 0; k < v.index.size(); ++k) {
                                          mesh.positions[v.index[k]] = Vec3f(v.points[k].jet.p);
                                          mesh.normals[v.index[k]] = Vec3f(v.points[k].jet.n);
                                      }
                                  },
                              .at_junction =
                                  [](const JunctionVertices& v, Mesh& mesh, std::size_t) {
                                      std::uint32_t groups = 0; // groups are numbered in the order of their first side
                                      for (std::uint32_t j = 0; j < v.count; ++j)
                                          mesh.positions[v.first_index + j] = Vec3f(v.points[j].jet.p);
                                      for (std::size_t k = 0; k < v.sides.size(); ++k) {
                                          if (v.sides[k].normal_group != groups) continue;
                                          for (std::uint32_t j = 0; j < v.count; ++j)
                                              mesh.normals[v.normal_index(groups, j)] =
                                                  Vec3f(v.points[k * v.count + j].jet.n);
                                          ++groups;
                                      }
                                  }};
    out.mesh = tessellate(layout, writer);
    out.triangles = triangulate(out.mesh);
    sample_patches(surface, layout, out, progress);
    add_missing_normals(out);
    out.mesh.attributes = corner_attributes(layout, out.mesh);
}

/// The angle of a corner between its neighbours in the face.
double corner_angle(const Mesh& mesh, std::uint32_t begin, std::uint32_t end, std::uint32_t c) noexcept {
    const auto at = [&](std::uint32_t i) { return Vec3d(mesh.positions[mesh.corner_position[i]]); };
    const Vec3d a = unit_or_zero(at(c + 1 < end ? c + 1 : begin) - at(c)),
                b = unit_or_zero(at(c > begin ? c - 1 : end - 1) - at(c));
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

/// A corner's value becomes the mean over the corners that share its position and normal, weighted by their angles, so that
/// they stay one vertex in files.
Attribute averaged(const Mesh& mesh, const SurfaceMesh& surface, const char* name, float SurfaceSample::*value) {
    struct Sum {
        double value = 0, weight = 0;
        std::uint32_t next = no_index; ///< another normal of the position
    };
    std::vector<Sum> sums;
    std::vector<std::uint32_t> normal, head(mesh.positions.size(), no_index), of_corner(mesh.corners());
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            std::uint32_t& first = head[mesh.corner_position[c]];
            std::uint32_t at = first;
            while (at != no_index && normal[at] != mesh.corner_normal[c]) at = sums[at].next;
            if (at == no_index) {
                at = std::uint32_t(sums.size());
                sums.push_back({0, 0, std::exchange(first, at)});
                normal.push_back(mesh.corner_normal[c]);
            }
            const double weight = corner_angle(mesh, mesh.face_begin[f], mesh.face_begin[f + 1], c) + 1e-12;
            sums[at].value += weight * double(surface.samples[surface.corner_sample[c]].*value);
            sums[at].weight += weight;
            of_corner[c] = at;
        }
    Attribute out{.name = name, .components = 1, .values = {}};
    for (const std::uint32_t at : of_corner) out.values.push_back(float(sums[at].value / sums[at].weight));
    return out;
}

} // namespace

SurfaceMesh surface_mesh(const BaseSurface& surface, SurfaceKind kind, int rate, Progress* progress) {
    SurfaceMesh out{.kind = kind};
    if (kind == SurfaceKind::limit) tessellate_limit(surface, rate, out, progress);
    else keep_faces(surface, out);
    Mesh& mesh = out.mesh;
    std::vector<Vec3f> normals;
    normals.reserve(mesh.corners());
    for (const std::uint32_t n : mesh.corner_normal) normals.push_back(mesh.normals[n]);
    mesh.tangents.clear();
    if (!mesh.corner_uv.empty()) mesh.tangents = corner_tangents(mesh, out.triangles, normals);
    std::erase_if(mesh.attributes,
                  [](const Attribute& a) { return a.name == "mean_curvature" || a.name == "gauss_curvature"; });
    Attribute mean = averaged(mesh, out, "mean_curvature", &SurfaceSample::mean);
    Attribute gauss = averaged(mesh, out, "gauss_curvature", &SurfaceSample::gauss);
    mesh.attributes.push_back(std::move(mean));
    mesh.attributes.push_back(std::move(gauss));
    return out;
}

} // namespace bake
