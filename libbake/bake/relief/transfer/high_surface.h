// One or more meshes with detail, on which rays from a low-poly mesh land.
#pragma once
#include "bake/mesh/triangulate.h"
#include "bake/ray/bvh.h"
#include "bake/relief/transfer/edge_normals.h"
#include "bake/relief/transfer/lanes.h"
#include <string>

namespace bake {

enum class HighNormals {
    smooth, ///< interpolated from the corners, as the mesh is shaded
    curved, ///< the same with the curvature between corners, nearer to the smooth surface that the mesh stands for
    facet,  ///< of the triangle that was hit
};

/// A high-poly mesh, and the name by which messages call it.
struct HighMesh {
    Mesh mesh;
    std::string name;
};

/// Triangles of several meshes in one tree. Rays land on the front of triangles, the side from which their corners are
/// counter-clockwise, and pass through the back.
class HighSurface {
public:
    /// Positions become relative to `origin`, that of the low-poly mesh. `rays`: how many will be cast, by which the tree is
    /// chosen. Throws Error{Refusal::unsuitable}, which names the mesh, if one has no faces.
    HighSurface(std::vector<HighMesh> meshes, const Vec3d& origin, HighNormals normals, double rays,
                std::uint32_t first_number = 1);

    /// In it, rays meet both sides.
    const Bvh& bvh() const noexcept { return bvh_; }
    void land(std::span<const Ray, packet_size> rays, PacketMask active,
              std::span<Hit, packet_size> hits) const noexcept {
        bvh_.intersect_fronts(rays, active, hits);
    }
    Hit land(const Ray& ray) const noexcept;
    std::size_t count() const noexcept { return parts_.size(); }
    const Mesh& mesh(std::size_t i) const noexcept { return parts_[i].high.mesh; }
    const std::string& name(std::size_t i) const noexcept { return parts_[i].high.name; }
    const std::vector<Triangle>& triangles(std::size_t i) const noexcept { return parts_[i].triangles; }
    std::size_t triangle_count() const noexcept { return bvh_.triangle_count(); }
    /// Of all meshes.
    const Bounds& bounds() const noexcept { return bounds_; }

    Vec3f position(const Hit& hit) const noexcept;
    /// Unit normal at a hit; that of the facet where the corners' normals cancel out, zero if the facet has no area.
    Vec3f normal(const Hit& hit) const noexcept;
    /// The same for the hits of a packet; lanes without a hit get anything.
    void normals(std::span<const Hit, packet_size> hits, std::size_t count, Lanes3& out) const noexcept;
    Vec3f facet_normal(std::size_t mesh, std::uint32_t triangle) const noexcept;
    Vec3f corner_position(std::size_t mesh, std::uint32_t triangle, std::uint32_t k) const noexcept;
    /// As normal(), at a corner.
    Vec3f corner_normal(std::size_t mesh, std::uint32_t triangle, std::uint32_t k) const noexcept;
    /// Counts meshes, and within each the materials of its faces, from `first_number` of the constructor on.
    std::uint32_t part_number(const Hit& hit) const noexcept;
    /// The first number after those of this surface.
    std::uint32_t next_number() const noexcept { return next_number_; }

private:
    struct Part {
        HighMesh high;
        std::vector<Triangle> triangles;
        std::vector<Vec3f> normals;     ///< corners; empty for facet normals
        std::vector<EdgeNormals> edges; ///< triangles; empty unless normals are curved
        std::uint32_t first_number = 1; ///< of its faces without a material
    };
    static std::vector<Part> parts_of(std::vector<HighMesh> meshes, const Vec3d& origin, HighNormals normals,
                                      std::uint32_t& number);
    static Bvh tree_of(const std::vector<Part>& parts, double rays);

    std::uint32_t next_number_;
    std::vector<Part> parts_;
    Bvh bvh_;
    Bounds bounds_;
};

} // namespace bake
