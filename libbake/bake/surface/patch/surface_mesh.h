// Converts a surface to a mesh for writing: normals, tangents, curvatures, and the patch and parameters of each corner.
#pragma once
#include "bake/mesh/triangulate.h"
#include "bake/surface/patch/base_surface.h"

namespace bake {

class Progress;

/// What a BaseSurface was made from.
enum class SurfaceKind { mesh, limit, shape };

/// Why quantities do not exist at a point.
enum class Degenerate : unsigned char {
    none,
    pole,           ///< p_u x p_v is 0, but there is a normal: the limit, or that of the meridian
    without_normal, ///< p_u x p_v is 0, and there is no normal
    no_chart,       ///< a normal, but no area in uv: p_u and p_v do not exist
};

/// The quantities of one point, with respect to the uv chart.
struct SurfaceValues {
    Vec3d p{0}, n{0}, p_u{0}, p_v{0};
    double sigma = 0; ///< -1 on mirrored charts, 0 without chart
    double mean_curvature = 0, gauss_curvature = 0;
    Degenerate degenerate = Degenerate::none;
};
/// p_u and p_v are zero where the chart has no area, curvatures zero where there is no tangent plane. Without uvs
/// (`has_uv` false) no_chart is not reported.
SurfaceValues surface_values(const SurfacePoint& point, bool has_uv) noexcept;

/// Patch and parameters of a triangle of the mesh. Its three corners are in one patch.
struct TrianglePlace {
    std::uint32_t patch;
    Vec2d st[3];
};

/// One point of a patch. Several corners of the mesh may show it.
struct SurfaceSample {
    Vec3f n;
    float length_u, length_v; ///< |p_u|, |p_v|
    float mean, gauss;        ///< curvatures
    Degenerate degenerate;
};

struct SurfaceMesh {
    SurfaceKind kind = SurfaceKind::mesh;
    Mesh mesh;
    std::vector<Triangle> triangles;   ///< triangulate(mesh)
    std::vector<TrianglePlace> places; ///< triangles
    std::vector<SurfaceSample> samples;
    std::vector<std::uint32_t> corner_sample; ///< corners
};

/// Meshes and shapes keep their faces; each patch of a limit surface becomes rate x rate quads or rate^2 triangles. Has
/// unit normals, MikkTSpace tangents if there are uvs, and the attributes mean_curvature and gauss_curvature, averaged over
/// the corners that share a position and a normal. At a degenerate corner they are those of a point 1/1024 of the way to the middle of the patch, e.g. at a sphere's pole.
/// Throws Error{Refusal::unsuitable} for more corners than a mesh can have.
SurfaceMesh surface_mesh(const BaseSurface& surface, SurfaceKind kind, int rate = 1, Progress* progress = nullptr);

} // namespace bake
