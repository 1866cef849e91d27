// A mesh prepared for shading, with interpolation over its triangles, in object space.
#pragma once
#include "bake/surface/chart/mesh_surface.h"
#include <memory>

namespace bake {

class BaseSurface;

/// Owns its mesh. Must not be moved, because the surface points to the mesh.
struct Shape {
    Mesh mesh;
    MeshSurface surface;
    std::vector<Vec4f> tangents;               ///< per corner; empty before add_tangents()
    std::shared_ptr<const BaseSurface> smooth; ///< what the mesh shows, for displacement; null: the mesh itself
};

/// `options` can select flat shading (facet normals), and leave out the derivatives: add_derivatives(shape.surface)
/// computes them for a material that needs them.
std::unique_ptr<Shape> make_shape(Mesh mesh, const SurfaceOptions& options = {});
/// Computes MikkTSpace tangents, unless the shape has them already.
void add_tangents(Shape& shape);

/// The point (1 - b1 - b2) corner[0] + b1 corner[1] + b2 corner[2] of a triangle.
struct ShapePoint {
    std::uint32_t triangle = 0;
    float b1 = 0, b2 = 0;
};

/// (0, 0) if a corner has no uv.
Vec2f uv_at(const Shape& shape, const ShapePoint& at) noexcept;
/// The interpolated normal, not normalised. For flat shapes the unit facet normal. Zero where there is no normal.
Vec3f normal_at(const Shape& shape, const ShapePoint& at) noexcept;
/// Offset from the facet to the smooth surface that the normals describe: the mean of the point's projections on the tangent
/// planes of the corners, as far as these are outside. Shadow rays that start there do not hit the facets of a coarse mesh
/// around the point. Zero for flat shapes. `outward` is -1 if the surface is seen from inside, else 1.
/// Hanika, Hacking the Shadow Terminator, Ray Tracing Gems II, 2021.
Vec3f smooth_offset(const Shape& shape, const ShapePoint& at, float outward) noexcept;

} // namespace bake
