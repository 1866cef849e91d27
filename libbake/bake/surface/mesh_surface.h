// A UV-mapped mesh as a smooth surface: a jet at any point of any triangle.
#pragma once
#include "bake/asset/triangulate.h"
#include "bake/surface/jet.h"

namespace bake {

struct SurfaceOptions {
    bool flat = false; ///< facet normals and facet tangents; else smooth ones
};

/// Per corner: unit normal n, and p_u, p_v, averaged over the face corners at the vertex that share its uv chart
/// (position, uv and normal alike, same orientation in uv), each by its area in uv. The mesh must outlive the surface.
struct MeshSurface {
    const Mesh* mesh = nullptr;
    std::vector<Triangle> triangles; ///< as triangulate(mesh) gives them
    std::vector<Vec3f> n;            ///< corners; unit; the file's own, else angle-weighted per position; zero where none exists
    std::vector<Vec3f> p_u, p_v;     ///< corners; zero where the chart has no area or the mesh no uv
    std::vector<float> sigma;        ///< triangles; -1 mirrored in uv, +1 otherwise, 0 without area in uv
    bool flat = false;
};

MeshSurface make_mesh_surface(const Mesh& mesh, const SurfaceOptions& options = {});

/// The corner normals alone, one unit vector per corner: the file's own where it has them, else the mean of the facet
/// normals around the position weighted by their angles there; zero where no face has area.
std::vector<Vec3f> corner_normals(const Mesh& mesh, const std::vector<Triangle>& triangles);

/// Jet at barycentrics (1 - b1 - b2, b1, b2) of a triangle. n is the interpolated unit normal; p_u and p_v are
/// interpolated and projected perpendicular to n, so that a flat height gives n exactly; n_u and n_v are the
/// derivatives of the interpolated unit normal along u and v. All zero, sigma too, where the triangle has no area in uv
/// or no normal.
template <class T> Jet<T> jet_at(const MeshSurface& surface, std::uint32_t triangle, T b1, T b2) noexcept;

} // namespace bake
