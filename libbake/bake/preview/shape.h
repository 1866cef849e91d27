// A mesh as the preview shades it: its surface, and what is interpolated over its triangles. All in object space.
#pragma once
#include "bake/surface/chart/mesh_surface.h"
#include <memory>

namespace bake {

/// Owns its mesh; does not move, because the surface points at the mesh.
struct Shape {
    Mesh mesh;
    MeshSurface surface;
    std::vector<Vec4f> tangents; ///< corners, from add_tangents; empty until a normal map needs them
};

/// Flat shading (facet normals) by `options`.
std::unique_ptr<Shape> make_shape(Mesh mesh, const SurfaceOptions& options = {});
/// MikkTSpace for the shape's corners; does nothing the second time.
void add_tangents(Shape& shape);

/// A point of a triangle: (1 - b1 - b2) corner[0] + b1 corner[1] + b2 corner[2].
struct ShapePoint {
    std::uint32_t triangle = 0;
    float b1 = 0, b2 = 0;
};

/// (0, 0) where a corner has no uv.
Vec2f uv_at(const Shape& shape, const ShapePoint& at) noexcept;
/// The normal interpolated without normalising; the unit facet normal when the shape is flat; zero where there is none.
Vec3f normal_at(const Shape& shape, const ShapePoint& at) noexcept;
/// How far the smooth surface that the normals promise stands off the facet: the mean of the point's projections on the
/// corners' tangent planes, where those lie outside. Shadow rays that begin there do not meet the coarse facets around
/// them. Zero for flat shapes. `outward` is 1, or -1 when the surface is seen from inside.
/// Hanika, Hacking the Shadow Terminator, Ray Tracing Gems II, 2021.
Vec3f off_facet(const Shape& shape, const ShapePoint& at, float outward) noexcept;

} // namespace bake
