#include "bake/surface/patch/surface_mesh.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/surface/chart/tangent_space.h"
#include "bake/surface/point/curvature.h"

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

/// What patches say of a point they share differs by less than this, unless there is a crease or a seam.
constexpr float same_normal = 1e-3f, same_uv = 1e-6f;

constexpr Vec2d quad_corner[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle_corner[] = {{0, 0}, {1, 0}, {0, 1}};

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

/// Keeps the values that `index` names, in order of first use, and renumbers it.
template <class T> void keep_used(std::vector<T>& values, std::vector<std::uint32_t>& index) {
    std::vector<std::uint32_t> number(values.size(), no_index);
    std::vector<T> out;
    for (std::uint32_t& i : index) {
        if (i == no_index) continue;
        if (number[i] == no_index) {
            number[i] = std::uint32_t(out.size());
            out.push_back(values[i]);
        }
        i = number[i];
    }
    values = std::move(out);
}

/// Per point, the first of its group with the same value up to `tolerance`. Groups are numbered below the points' number.
template <class Value>
std::vector<std::uint32_t> first_alike(std::size_t points, const std::vector<std::uint32_t>& group, float tolerance,
                                       const Value& value) {
    std::vector<std::uint32_t> out(points), last(points, no_index), before(points);
    for (std::uint32_t i = 0; i < points; ++i) {
        std::uint32_t& head = last[group[i]];
        std::uint32_t at = head;
        while (at != no_index && glm::length(value(i) - value(at)) > tolerance) at = before[at];
        if (at == no_index) at = i, before[i] = head, head = i;
        out[i] = at;
    }
    return out;
}

/// Meshes and shapes: quads are one patch, other polygons one per triangle, in the order of the faces.
void as_it_is(const BaseSurface& surface, SurfaceMesh& out) {
    out.mesh = surface.mesh();
    out.triangles = triangulate(out.mesh);
    const Mesh& mesh = out.mesh;
    std::vector<std::pair<std::uint32_t, Vec2d>> place(mesh.corners(), {no_index, Vec2d(0)});
    std::uint32_t patch = 0;
    for (std::size_t t = 0; t < out.triangles.size(); ++t) {
        const Triangle& triangle = out.triangles[t];
        const std::uint32_t first = mesh.face_begin[triangle.face];
        const bool quad = mesh.face_begin[triangle.face + 1] - first == 4;
        TrianglePlace& here = out.places.emplace_back();
        here.patch = patch;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t c = triangle.corner[k];
            here.st[k] = quad ? quad_corner[c - first] : triangle_corner[k];
            if (place[c].first == no_index) place[c] = {patch, here.st[k]};
        }
        const bool second_half = quad && t > 0 && out.triangles[t - 1].face == triangle.face;
        patch += !quad || second_half;
    }
    out.samples.resize(mesh.corners());
    out.corner_sample.resize(mesh.corners());
    for_rows(std::int64_t(mesh.corners()), 1024, [&](std::int64_t begin, std::int64_t end) {
        for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
            SurfacePoint point;
            surface.evaluate(place[c].first, {&place[c].second, 1}, {&point, 1});
            out.samples[c] = sample_at(surface, place[c].first, place[c].second, point);
            out.corner_sample[c] = std::uint32_t(c);
        }
    });
    if (out.kind != SurfaceKind::mesh) return;               // tessellate() has exact normals
    keep_used(out.mesh.positions, out.mesh.corner_position); // no more positions than corners are left
    const auto normal = [&](std::uint32_t c) { return out.samples[c].n; };
    out.mesh.corner_normal = first_alike(mesh.corners(), out.mesh.corner_position, 0, normal);
    out.mesh.normals.clear();
    for (const SurfaceSample& sample : out.samples) out.mesh.normals.push_back(sample.n);
    keep_used(out.mesh.normals, out.mesh.corner_normal);
}

/// Numbers of the points of one patch's lattice.
struct Lattice {
    int rate;
    bool quad;
    std::uint32_t size() const noexcept {
        const auto n = std::uint32_t(rate + 1);
        return quad ? n * n : n * (n + 1) / 2;
    }
    std::uint32_t at(int i, int j) const noexcept {
        return std::uint32_t(quad ? j * (rate + 1) + i : j * (rate + 1) - j * (j - 1) / 2 + i);
    }
    int row_length(int j) const noexcept { return quad ? rate + 1 : rate + 1 - j; }
    /// Point k of side `side`.
    std::uint32_t on_side(int side, int k) const noexcept {
        if (quad)
            return side == 0 ? at(k, 0) : side == 1 ? at(rate, k) : side == 2 ? at(rate - k, rate) : at(0, rate - k);
        return side == 0 ? at(k, 0) : side == 1 ? at(rate - k, k) : at(0, rate - k);
    }
};

/// Per lattice point of every patch, the first one that is the same point of the surface.
std::vector<std::uint32_t> first_points(const PatchComplex& complex, const std::vector<std::uint32_t>& begin,
                                        int rate) {
    std::vector<std::uint32_t> first(begin.back());
    for (std::uint32_t i = 0; i < begin.back(); ++i) first[i] = i;
    std::vector<std::uint32_t> vertex(complex.vertices, no_index), edge(complex.edges, no_index);
    for (std::uint32_t p = 0; p < complex.patches.size(); ++p) {
        const PatchComplex::Patch& patch = complex.patches[p];
        const Lattice lattice{rate, patch.sides() == 4};
        for (int side = 0; side < patch.sides(); ++side) {
            const std::uint32_t corner = begin[p] + lattice.on_side(side, 0);
            std::uint32_t& at_vertex = vertex[patch.vertex[std::size_t(side)]];
            if (at_vertex == no_index) at_vertex = corner;
            first[corner] = at_vertex;
            // Side `side` of patch `owner` was the first on this edge.
            std::uint32_t& owner = edge[patch.edge[std::size_t(side)]];
            if (owner == no_index) {
                owner = 4 * p + std::uint32_t(side);
                continue;
            }
            const PatchComplex::Patch& other = complex.patches[owner / 4];
            const Lattice others{rate, other.sides() == 4};
            const bool against = patch.reversed[std::size_t(side)] != other.reversed[owner % 4];
            for (int k = 1; k < rate; ++k)
                first[begin[p] + lattice.on_side(side, k)] =
                    begin[owner / 4] + others.on_side(int(owner % 4), against ? rate - k : k);
        }
    }
    return first;
}

void limit_lattice(const BaseSurface& surface, int rate, SurfaceMesh& out, Progress* progress) {
    const PatchComplex& complex = surface.complex();
    const Mesh& cage = surface.mesh();
    const bool has_uv = !cage.corner_uv.empty();
    double total = 0;
    for (const auto& patch : complex.patches) total += patch.sides() == 4 ? 4.0 * rate * rate : 3.0 * rate * rate;
    if (total + double(complex.patches.size()) * 4 * rate > 4e9)
        throw Error{Refusal::unsuitable, "the limit surface: " + std::to_string(complex.patches.size()) +
                                             " patches of " + std::to_string(rate) + " x " + std::to_string(rate) +
                                             " cells are more than a mesh can have; take a lower --resolution"};
    std::vector<std::uint32_t> begin{0};
    for (const auto& patch : complex.patches) begin.push_back(begin.back() + Lattice{rate, patch.sides() == 4}.size());

    Mesh& mesh = out.mesh;
    mesh.positions.resize(begin.back());
    mesh.uvs.resize(has_uv ? begin.back() : 0);
    out.samples.resize(begin.back());
    for_rows(
        std::int64_t(complex.patches.size()), 4,
        [&](std::int64_t from, std::int64_t to) {
            std::vector<SurfacePoint> points;
            for (auto p = std::uint32_t(from); p < std::uint32_t(to); ++p) {
                const Lattice lattice{rate, complex.patches[p].sides() == 4};
                points.resize(lattice.size());
                surface.evaluate_lattice(p, rate, points);
                for (int j = 0; j <= rate; ++j)
                    for (int i = 0; i < lattice.row_length(j); ++i) {
                        const SurfacePoint& point = points[lattice.at(i, j)];
                        const std::uint32_t at = begin[p] + lattice.at(i, j);
                        mesh.positions[at] = Vec3f(point.jet.p);
                        if (has_uv) mesh.uvs[at] = Vec2f(point.uv);
                        out.samples[at] = sample_at(surface, p, Vec2d(double(i) / rate, double(j) / rate), point);
                    }
            }
        },
        progress);

    // Points that are one share what is equal up to rounding.
    const std::vector<std::uint32_t> first = first_points(complex, begin, rate);
    const auto normal_at = [&](std::uint32_t i) { return out.samples[i].n; };
    const auto uv_at = [&](std::uint32_t i) { return mesh.uvs[i]; };
    const std::vector<std::uint32_t> normal = first_alike(first.size(), first, same_normal, normal_at);
    std::vector<std::uint32_t> uv;
    if (has_uv) uv = first_alike(first.size(), first, same_uv, uv_at);
    mesh.normals.resize(begin.back());
    for (std::uint32_t i = 0; i < begin.back(); ++i) mesh.normals[i] = out.samples[i].n;

    mesh.materials = cage.materials, mesh.groups = cage.groups;
    for (std::uint32_t p = 0; p < complex.patches.size(); ++p) {
        const PatchComplex::Patch& patch = complex.patches[p];
        const Lattice lattice{rate, patch.sides() == 4};
        const auto face = [&](std::initializer_list<std::pair<int, int>> corners) {
            for (const auto& [i, j] : corners) {
                const std::uint32_t at = begin[p] + lattice.at(i, j);
                mesh.corner_position.push_back(first[at]);
                mesh.corner_normal.push_back(normal[at]);
                if (has_uv) mesh.corner_uv.push_back(uv[at]);
                out.corner_sample.push_back(at);
            }
            mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
            if (!cage.face_material.empty()) mesh.face_material.push_back(cage.face_material[patch.face]);
            if (!cage.face_group.empty()) mesh.face_group.push_back(cage.face_group[patch.face]);
        };
        for (int j = 0; j < rate; ++j)
            for (int i = 0; i < (lattice.quad ? rate : rate - j); ++i) {
                if (lattice.quad) {
                    face({{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
                    continue;
                }
                face({{i, j}, {i + 1, j}, {i, j + 1}});
                if (i + j + 1 < rate) face({{i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
            }
    }
    out.triangles = triangulate(mesh);
    out.places.resize(out.triangles.size());
    std::vector<std::uint32_t> patch_of(begin.back());
    std::vector<Vec2d> st_of(begin.back());
    for (std::uint32_t p = 0; p < complex.patches.size(); ++p) {
        const Lattice lattice{rate, complex.patches[p].sides() == 4};
        for (int j = 0; j <= rate; ++j)
            for (int i = 0; i < lattice.row_length(j); ++i) {
                patch_of[begin[p] + lattice.at(i, j)] = p;
                st_of[begin[p] + lattice.at(i, j)] = {double(i) / rate, double(j) / rate};
            }
    }
    for (std::size_t t = 0; t < out.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t at = out.corner_sample[out.triangles[t].corner[k]];
            out.places[t].patch = patch_of[at];
            out.places[t].st[k] = st_of[at];
        }
    keep_used(mesh.positions, mesh.corner_position);
    keep_used(mesh.normals, mesh.corner_normal);
    keep_used(mesh.uvs, mesh.corner_uv);
}

} // namespace

SurfaceMesh surface_mesh(const BaseSurface& surface, SurfaceKind kind, int rate, Progress* progress) {
    SurfaceMesh out{.kind = kind};
    if (kind == SurfaceKind::limit) limit_lattice(surface, rate, out, progress);
    else as_it_is(surface, out);
    Mesh& mesh = out.mesh;
    std::vector<Vec3f> normals;
    normals.reserve(mesh.corners());
    for (const std::uint32_t n : mesh.corner_normal) normals.push_back(mesh.normals[n]);
    mesh.tangents.clear();
    if (!mesh.corner_uv.empty()) mesh.tangents = corner_tangents(mesh, out.triangles, normals);
    Attribute mean{.name = "mean_curvature"}, gauss{.name = "gauss_curvature"};
    for (const std::uint32_t s : out.corner_sample) {
        mean.values.push_back(out.samples[s].mean);
        gauss.values.push_back(out.samples[s].gauss);
    }
    mesh.attributes.push_back(std::move(mean));
    mesh.attributes.push_back(std::move(gauss));
    return out;
}

} // namespace bake
