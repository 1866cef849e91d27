#include "bake/surface/patch/base_surface.h"
#include "bake/base/parallel.h"
#include "bake/mesh/topology.h"
#include "bake/mesh/weld.h"
#include "bake/surface/patch/mesh_patch.h"
#include "bake/surface/patch/patch_domain.h"
#include "bake/surface/point/curvature.h"
#include <algorithm>
#include <limits>
#include <variant>

namespace bake {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();
constexpr std::size_t chunk = 64; ///< points evaluated at a time

using Corners = std::array<std::uint32_t, 4>;
using Patches = std::vector<PatchComplex::Patch>;

// A mesh as it is.

struct MeshBase {
    MeshSurface surface;
    std::vector<Corners> corners; ///< patches
};

/// Triangles and quads as they are, the triangles of larger polygons.
MeshBase make_mesh_base(const Mesh& mesh, Patches& patches) {
    MeshBase base{make_mesh_surface(mesh), {}};
    base.corners.reserve(mesh.faces());
    patches.reserve(mesh.faces());
    const auto add = [&](const Corners& corners, std::uint32_t face) {
        PatchComplex::Patch patch{.face = face};
        for (int k = 0; k < 4; ++k)
            patch.vertex[k] = corners[k] == no_index ? no_index : mesh.corner_position[corners[k]];
        base.corners.push_back(corners);
        patches.push_back(patch);
    };
    const Triangle* triangle = base.surface.triangles.data();
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t c = mesh.face_begin[f], count = mesh.face_begin[f + 1] - c;
        if (count == 4) add({c, c + 1, c + 2, c + 3}, f);
        for (std::uint32_t i = 0; i < count - 2; ++i, ++triangle)
            if (count != 4) add({triangle->corner[0], triangle->corner[1], triangle->corner[2], no_index}, f);
    }
    return base;
}

void evaluate(const MeshBase& base, std::uint32_t patch, std::span<const Vec2d> st,
              std::span<SurfacePoint> out) noexcept {
    const MeshPatch p = mesh_patch(base.surface, base.corners[patch]);
    for (std::size_t i = 0; i < st.size(); ++i) out[i] = point_at(p, st[i].x, st[i].y);
}

// The limit surface of a cage.

struct LimitBase {
    SubdivisionSurface surface;
    bool quarters = false;                        ///< every quad of the cage is four patches
    std::vector<std::uint32_t> limit;             ///< patches: the patch of `surface` that has it
    std::vector<std::uint8_t> corner;             ///< patches: 0 for a whole one, 1 + k for the quarter at corner k
    std::vector<std::uint8_t> extraordinary = {}; ///< patches: bit k for corner k
};

/// Which corners of the patches are extraordinary: inner vertices whose valence is not that of a regular lattice.
std::vector<std::uint8_t> extraordinary_corners(const PatchComplex& complex) {
    std::vector<std::uint8_t> edge_patches(complex.edges, 0);
    for (const PatchComplex::Patch& patch : complex.patches)
        for (int k = 0; k < patch.sides(); ++k)
            edge_patches[patch.edge[k]] = std::uint8_t(std::min(edge_patches[patch.edge[k]] + 1, 2));
    std::vector<std::uint32_t> valence(complex.vertices, 0);
    std::vector<bool> inner(complex.vertices, true);
    for (const PatchComplex::Patch& patch : complex.patches)
        for (int k = 0; k < patch.sides(); ++k) {
            ++valence[patch.vertex[k]];
            if (edge_patches[patch.edge[k]] == 2) continue;
            inner[patch.vertex[k]] = inner[patch.vertex[(k + 1) % patch.sides()]] = false;
        }
    std::vector<std::uint8_t> corners(complex.patches.size(), 0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const PatchComplex::Patch& patch = complex.patches[i];
        const std::uint32_t regular = patch.sides() == 4 ? 4 : 6;
        for (int k = 0; k < patch.sides(); ++k)
            if (inner[patch.vertex[k]] && valence[patch.vertex[k]] != regular) corners[i] |= std::uint8_t(1 << k);
    }
    return corners;
}

/// Clears `curved` at a corner that is an extraordinary vertex.
void mark_extraordinary(std::uint8_t corners, bool quad, const Vec2d& st, SurfacePoint& point) noexcept {
    if (corners == 0) return;
    for (int k = 0; k < (quad ? 4 : 3); ++k)
        if (corners >> k & 1 && st == patch_corners(quad ? 4 : 3)[k]) point.curved = false;
}

/// The quarter at corner k of a quad: (s, t) of the quarter is origin + s along_s + t along_t in the quad.
struct Quarter {
    Vec2d origin, along_s, along_t;
};
constexpr Quarter quarter_at[] = {{{0, 0}, {0.5, 0}, {0, 0.5}},
                                  {{1, 0}, {0, 0.5}, {-0.5, 0}},
                                  {{1, 1}, {-0.5, 0}, {0, -0.5}},
                                  {{0, 1}, {0, -0.5}, {0.5, 0}}};

bool all_quads(const Mesh& mesh) {
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        if (mesh.face_begin[f + 1] - mesh.face_begin[f] != 4) return false;
    return true;
}

/// Patches whose corners are the cage's.
LimitBase whole_patches(const Mesh& cage, SubdivisionSurface surface, Patches& patches) {
    const std::uint32_t count = surface.patches();
    LimitBase base{std::move(surface), false, {}, std::vector<std::uint8_t>(count, 0)};
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t face = base.surface.face(i), first = cage.face_begin[face];
        PatchComplex::Patch patch{.vertex = {no_index, no_index, no_index, no_index}, .face = face};
        for (std::uint32_t k = 0; k < cage.face_begin[face + 1] - first; ++k)
            patch.vertex[k] = cage.corner_position[first + k];
        patches.push_back(patch);
        base.limit.push_back(i);
    }
    return base;
}

/// One patch per corner of the cage, between that corner, the middles of its two sides and the middle of the face.
LimitBase corner_patches(const Mesh& cage, SubdivisionSurface surface, Patches& patches) {
    std::vector<std::uint32_t> next(cage.corners()), before(cage.corners());
    for (std::uint32_t f = 0; f < cage.faces(); ++f)
        for (std::uint32_t c = cage.face_begin[f]; c < cage.face_begin[f + 1]; ++c) {
            next[c] = c + 1 < cage.face_begin[f + 1] ? c + 1 : cage.face_begin[f];
            before[next[c]] = c;
        }
    const auto vertices = std::uint32_t(cage.positions.size());
    const EdgeTable table = make_edges(vertices, std::uint32_t(cage.corners()), [&](std::uint32_t c) -> SideEnds {
        return {cage.corner_position[c], cage.corner_position[next[c]]};
    });
    LimitBase base{std::move(surface), true, {}, {}};
    for (std::uint32_t i = 0; i < base.surface.patches(); ++i) {
        const std::uint32_t face = base.surface.face(i), first = cage.face_begin[face];
        const bool quad = cage.face_begin[face + 1] - first == 4;
        for (std::uint32_t k = 0; k < (quad ? 4u : 1u); ++k) {
            const std::uint32_t c = first + (quad ? k : base.surface.corner(i));
            patches.push_back({.vertex = {cage.corner_position[c], vertices + table.edge[c],
                                          vertices + table.edges() + face, vertices + table.edge[before[c]]},
                               .face = face});
            base.limit.push_back(i);
            base.corner.push_back(std::uint8_t(quad ? 1 + k : 0));
        }
    }
    return base;
}

/// Faces of the cage without a patch.
std::size_t faces_left_out(const Mesh& cage, const Patches& patches) {
    std::vector<bool> there(cage.faces(), false);
    for (const PatchComplex::Patch& patch : patches) there[patch.face] = true;
    return std::size_t(std::count(there.begin(), there.end(), false));
}

LimitBase make_limit_base(const Mesh& cage, const SubdivisionOptions& options, const std::string& path,
                          Patches& patches) {
    SubdivisionSurface surface(cage, options, path);
    return options.scheme == Scheme::catmark && !all_quads(cage) ? corner_patches(cage, std::move(surface), patches)
                                                                 : whole_patches(cage, std::move(surface), patches);
}

/// Where p_s and p_t are parallel, as at a corner whose two sides are one smooth crease, their cross product is rounding
/// error, and the normal is its limit from the inside of the patch. At the tip of a spike (a sharp vertex without creases)
/// the second derivatives are parallel too, and there is no normal.
SurfacePoint point_of(const LimitPoint& limit, const Vec2d& st) noexcept {
    const Jet2<double> s{limit.p, limit.p_s, limit.p_t, limit.p_ss, limit.p_st, limit.p_tt};
    SurfacePoint point{.jet = jet_of(s), .uv = limit.uv, .uv_s = limit.uv_s, .uv_t = limit.uv_t};
    const Vec3d N = glm::cross(s.p_u, s.p_v);
    // The angle of the two is above 1e-5: ten times the error of the limit.
    if (glm::dot(N, N) > 1e-10 * glm::dot(s.p_u, s.p_u) * glm::dot(s.p_v, s.p_v)) return point;
    const Vec3d along_s = glm::cross(s.p_uu, s.p_v) + glm::cross(s.p_u, s.p_uv);
    const Vec3d along_t = glm::cross(s.p_uv, s.p_v) + glm::cross(s.p_u, s.p_vv);
    const Vec2d inwards = Vec2d(1.0 / 3, 1.0 / 3) - st;
    const Vec3d normal = inwards.x * along_s + inwards.y * along_t;
    const double first = std::max(glm::length(s.p_u), glm::length(s.p_v));
    const double second = std::max({glm::length(s.p_uu), glm::length(s.p_uv), glm::length(s.p_vv)});
    point.jet.n = glm::length(normal) > 1e-5 * first * second ? unit_or_zero(normal) : Vec3d(0);
    point.jet.sigma = 0;
    return point;
}

/// Converts derivatives along the axes of a patch to derivatives along the axes of a quarter of the patch.
void rotate_derivatives(const Quarter& q, SurfacePoint& point) noexcept {
    const auto along = [&](auto& a, auto& b) {
        const auto s = q.along_s.x * a + q.along_s.y * b, t = q.along_t.x * a + q.along_t.y * b;
        a = s, b = t;
    };
    along(point.jet.p_u, point.jet.p_v);
    along(point.jet.n_u, point.jet.n_v);
    along(point.uv_s, point.uv_t);
}

void evaluate(const LimitBase& base, bool quad, std::uint32_t patch, std::span<const Vec2d> st,
              std::span<SurfacePoint> out) noexcept {
    const std::uint8_t extraordinary = base.extraordinary.empty() ? 0 : base.extraordinary[patch];
    const Quarter* quarter = base.corner[patch] == 0 ? nullptr : &quarter_at[base.corner[patch] - 1];
    LimitPoint points[chunk];
    Vec2d turned[chunk];
    for (std::size_t done = 0; done < st.size(); done += chunk) {
        auto places = st.subspan(done, std::min(chunk, st.size() - done));
        if (quarter) {
            for (std::size_t i = 0; i < places.size(); ++i)
                turned[i] = quarter->origin + places[i].x * quarter->along_s + places[i].y * quarter->along_t;
            places = {turned, places.size()};
        }
        base.surface.evaluate(base.limit[patch], places, Derivatives::second, {points, places.size()});
        for (std::size_t i = 0; i < places.size(); ++i) {
            out[done + i] = point_of(points[i], places[i]);
            if (quarter) rotate_derivatives(*quarter, out[done + i]);
            mark_extraordinary(extraordinary, quad, st[done + i], out[done + i]);
        }
    }
}

// An analytic shape.

struct ShapeBase {
    ParametricSurface shape;
    int columns, rows;
};

ShapeBase make_shape_base(const ParametricSurface& shape, int columns, int rows, const Mesh& mesh, Patches& patches) {
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t* p = &mesh.corner_position[mesh.face_begin[f]];
        patches.push_back({.vertex = {p[0], p[1], p[2], p[3]}, .face = f});
    }
    return {shape, columns, rows};
}

void evaluate(const ShapeBase& base, std::uint32_t patch, std::span<const Vec2d> st,
              std::span<SurfacePoint> out) noexcept {
    const int cells = base.columns * base.rows, cell = int(patch) % cells;
    const double du = 1.0 / base.columns, dv = 1.0 / base.rows;
    for (std::size_t i = 0; i < st.size(); ++i) {
        const Vec2d uv((cell % base.columns + st[i].x) / base.columns, (cell / base.columns + st[i].y) / base.rows);
        SurfacePoint& point = out[i];
        point = {.jet = base.shape.jet(uv.x, uv.y, int(patch) / cells), .uv = uv, .uv_s = {du, 0}, .uv_t = {0, dv}};
        point.jet.p_u *= du, point.jet.n_u *= du;
        point.jet.p_v *= dv, point.jet.n_v *= dv;
        if (point.jet.n == Vec3d(0)) point.jet.n = base.shape.side_normal(uv.x, uv.y, int(patch) / cells);
    }
}

/// Takes the uvs from faces that have some at a part of their corners alone.
void drop_partial_uvs(Mesh& mesh) {
    if (mesh.corner_uv.empty()) return;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const auto first = mesh.corner_uv.begin() + mesh.face_begin[f],
                   last = mesh.corner_uv.begin() + mesh.face_begin[f + 1];
        if (std::find(first, last, no_index) != last) std::fill(first, last, no_index);
    }
}

bool has_uvs(const Mesh& mesh, std::uint32_t face) noexcept {
    return !mesh.corner_uv.empty() && mesh.corner_uv[mesh.face_begin[face]] != no_index;
}

} // namespace

struct BaseSurface::Base {
    Mesh mesh;
    PatchComplex complex;
    Junctions junctions;
    std::variant<std::monostate, MeshBase, LimitBase, ShapeBase> kind;

    /// Connects patches of a limit surface or a shape, by what the surface is at their corners and the middles of their
    /// sides.
    void connect(Patches patches);
};

void BaseSurface::Base::connect(Patches patches) {
    static const Vec2d quad[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}};
    static const Vec2d triangle[] = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}, {0, 0.5}};
    std::vector<RimValue> values(patches.size() * 8);
    for_rows(std::int64_t(patches.size()), 256, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = begin; i < end; ++i) {
            SurfacePoint points[8];
            const std::span<const Vec2d> places(patches[i].sides() == 4 ? quad : triangle, 8);
            if (const auto* limit = std::get_if<LimitBase>(&kind))
                bake::evaluate(*limit, patches[i].sides() == 4, std::uint32_t(i), places, points);
            if (const auto* shape = std::get_if<ShapeBase>(&kind))
                bake::evaluate(*shape, std::uint32_t(i), places, points);
            const bool has_uv = has_uvs(mesh, patches[i].face);
            for (int k = 0; k < 8; ++k)
                values[8 * i + k] = {Vec3f(points[k].jet.n), has_uv ? points[k].uv : Vec2d(nowhere)};
        }
    });
    const auto rim = [&](std::uint32_t patch, int k) { return values[8 * std::size_t(patch) + k]; };
    complex = make_complex(std::move(patches), rim, true, 1e-7); // uvs are floats near 1
    if (auto* limit = std::get_if<LimitBase>(&kind)) limit->extraordinary = extraordinary_corners(complex);
    junctions = make_junctions(complex);
}

BaseSurface::BaseSurface(Mesh mesh) : base_(std::make_unique<Base>()) {
    base_->mesh = std::move(mesh);
    weld_positions(base_->mesh);
    drop_partial_uvs(base_->mesh);
    Patches patches;
    const MeshBase& base = base_->kind.emplace<MeshBase>(make_mesh_base(base_->mesh, patches));
    const auto rim = [&](std::uint32_t patch, int k) -> RimValue {
        const std::uint32_t corner = base.corners[patch][k];
        const std::uint32_t uv = base_->mesh.corner_uv.empty() ? no_index : base_->mesh.corner_uv[corner];
        return {base.surface.n[corner], uv == no_index ? Vec2d(nowhere) : Vec2d(base_->mesh.uvs[uv])};
    };
    base_->complex = make_complex(std::move(patches), rim, false, 0);
    base_->junctions = make_junctions(base_->complex);
}

BaseSurface::BaseSurface(Mesh cage, const SubdivisionOptions& options, const std::string& path)
    : base_(std::make_unique<Base>()) {
    base_->mesh = std::move(cage);
    drop_partial_uvs(base_->mesh);
    Patches patches;
    base_->kind.emplace<LimitBase>(make_limit_base(base_->mesh, options, path, patches));
    if (const std::size_t left_out = faces_left_out(base_->mesh, patches); left_out > 0)
        base_->mesh.notes.push_back("left out: " + std::to_string(left_out) + " of " +
                                    std::to_string(base_->mesh.faces()) +
                                    " faces, which lie at the border and have no limit surface under "
                                    "interpolateboundary 0; 1 or 2 keeps them");
    base_->connect(std::move(patches));
}

BaseSurface::BaseSurface(const ParametricSurface& shape, int columns, int rows) : base_(std::make_unique<Base>()) {
    base_->mesh = tessellate(shape, columns, rows);
    Patches patches;
    base_->kind.emplace<ShapeBase>(make_shape_base(shape, columns, rows, base_->mesh, patches));
    base_->connect(std::move(patches));
}

BaseSurface::~BaseSurface() = default;
BaseSurface::BaseSurface(BaseSurface&&) noexcept = default;

const Mesh& BaseSurface::mesh() const noexcept { return base_->mesh; }
const PatchComplex& BaseSurface::complex() const noexcept { return base_->complex; }
const Junctions& BaseSurface::junctions() const noexcept { return base_->junctions; }

bool BaseSurface::has_uv(std::uint32_t patch) const noexcept {
    return has_uvs(base_->mesh, base_->complex.patches[patch].face);
}

void BaseSurface::evaluate(std::uint32_t patch, std::span<const Vec2d> st, std::span<SurfacePoint> out) const noexcept {
    if (const auto* mesh = std::get_if<MeshBase>(&base_->kind)) bake::evaluate(*mesh, patch, st, out);
    if (const auto* limit = std::get_if<LimitBase>(&base_->kind))
        bake::evaluate(*limit, base_->complex.patches[patch].sides() == 4, patch, st, out);
    if (const auto* shape = std::get_if<ShapeBase>(&base_->kind)) bake::evaluate(*shape, patch, st, out);
}

void BaseSurface::evaluate_lattice(std::uint32_t patch, int rate, std::span<SurfacePoint> out) const {
    const bool quad = complex().patches[patch].sides() == 4;
    const LimitBase* limit = std::get_if<LimitBase>(&base_->kind);
    if (limit && limit->corner[patch] == 0) {
        thread_local std::vector<LimitPoint> row;
        row.resize(std::size_t(rate) + 1);
        std::size_t at = 0;
        for (int j = 0; j <= rate; ++j) {
            const int last = quad ? rate : rate - j;
            limit->surface.evaluate_rows(limit->limit[patch], rate, j, j + 1, Derivatives::second, row);
            for (int i = 0; i <= last; ++i, ++at) {
                const Vec2d st(double(i) / rate, double(j) / rate);
                out[at] = point_of(row[std::size_t(i)], st);
                mark_extraordinary(limit->extraordinary[patch], quad, st, out[at]);
            }
        }
        return;
    }
    Vec2d st[chunk];
    std::size_t filled = 0, done = 0;
    const auto flush = [&] {
        evaluate(patch, {st, filled}, out.subspan(done, filled));
        done += filled;
        filled = 0;
    };
    for (int j = 0; j <= rate; ++j)
        for (int i = 0; i <= (quad ? rate : rate - j); ++i) {
            st[filled++] = {double(i) / rate, double(j) / rate};
            if (filled == chunk) flush();
        }
    flush();
}

} // namespace bake
