#include "bake/surface/base_surface.h"
#include "bake/surface/mesh_patch.h"
#include "bake/surface/weld.h"
#include <limits>

namespace bake {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Bit-equal positions become the first of them.
void weld_positions(Mesh& mesh) {
    const Weld weld = weld_corners(mesh.positions, std::vector<Vec3f>(mesh.positions.size()), std::vector<Vec2f>(mesh.positions.size()));
    if (weld.vertices == mesh.positions.size()) return;
    std::vector<std::uint32_t> first(weld.vertices, no_index);
    for (std::uint32_t p = 0; p < mesh.positions.size(); ++p)
        if (first[weld.vertex[p]] == no_index) first[weld.vertex[p]] = p;
    for (std::uint32_t& p : mesh.corner_position) p = first[weld.vertex[p]];
}

using Corners = std::array<std::uint32_t, 4>;

/// The corners of every patch: triangles and quads as they are, the triangles of larger polygons.
std::vector<Corners> patch_corners(const Mesh& mesh, const std::vector<Triangle>& triangles, std::vector<std::uint32_t>& faces) {
    std::vector<Corners> patches;
    patches.reserve(mesh.faces());
    faces.reserve(mesh.faces());
    const Triangle* triangle = triangles.data();
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t c = mesh.face_begin[f], count = mesh.face_begin[f + 1] - c;
        if (count == 4) patches.push_back({c, c + 1, c + 2, c + 3}), faces.push_back(f);
        for (std::uint32_t i = 0; i < count - 2; ++i, ++triangle)
            if (count != 4) patches.push_back({triangle->corner[0], triangle->corner[1], triangle->corner[2], no_index}), faces.push_back(f);
    }
    return patches;
}

} // namespace

struct BaseSurface::Base {
    Mesh mesh;
    PatchComplex complex;
    MeshSurface surface;
    std::vector<Corners> corners; ///< patches
};

BaseSurface::BaseSurface(Mesh mesh) : base_(std::make_unique<Base>()) {
    Base& base = *base_;
    base.mesh = std::move(mesh);
    weld_positions(base.mesh);
    base.surface = make_mesh_surface(base.mesh);
    std::vector<std::uint32_t> faces;
    base.corners = patch_corners(base.mesh, base.surface.triangles, faces);

    std::vector<PatchComplex::Patch> patches(base.corners.size());
    for (std::size_t i = 0; i < patches.size(); ++i) {
        for (int k = 0; k < 4; ++k) {
            const std::uint32_t corner = base.corners[i][k];
            patches[i].vertex[k] = corner == no_index ? no_index : base.mesh.corner_position[corner];
        }
        patches[i].face = faces[i];
    }
    const auto rim = [&](std::uint32_t patch, int k) -> RimValue {
        const std::uint32_t corner = base.corners[patch][k];
        const std::uint32_t uv = base.mesh.corner_uv.empty() ? no_index : base.mesh.corner_uv[corner];
        return {base.surface.n[corner], uv == no_index ? Vec2d(nowhere) : Vec2d(base.mesh.uvs[uv])};
    };
    base.complex = make_complex(std::move(patches), rim, false, 0);
}

BaseSurface::~BaseSurface() = default;
BaseSurface::BaseSurface(BaseSurface&&) noexcept = default;

const Mesh& BaseSurface::mesh() const noexcept { return base_->mesh; }
const PatchComplex& BaseSurface::complex() const noexcept { return base_->complex; }

void BaseSurface::evaluate(std::uint32_t patch, std::span<const Vec2d> st, std::span<SurfacePoint> out) const noexcept {
    const MeshPatch p = mesh_patch(base_->surface, base_->corners[patch]);
    for (std::size_t i = 0; i < st.size(); ++i) out[i] = point_at(p, st[i].x, st[i].y);
}

void BaseSurface::evaluate_lattice(std::uint32_t patch, int rate, std::span<SurfacePoint> out) const noexcept {
    const MeshPatch p = mesh_patch(base_->surface, base_->corners[patch]);
    std::size_t at = 0;
    for (int j = 0; j <= rate; ++j)
        for (int i = 0; i <= (p.sides == 3 ? rate - j : rate); ++i) out[at++] = point_at(p, double(i) / rate, double(j) / rate);
}

} // namespace bake
