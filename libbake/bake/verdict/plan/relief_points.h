// Points of a placed shape with the relief of a height there, in world space.
#pragma once
#include "bake/preview/relief_method.h"
#include "bake/preview/scene.h"
#include <optional>

namespace bake {

/// Relative to scene.origin.
struct ReliefPoint {
    Vec3d p, n;                   ///< n has unit length
    Vec3d moved{0};               ///< displacement by the relief
    Vec3d texel_u{0}, texel_v{0}; ///< edges of a texel of the height
    double slope = 0;             ///< of the displaced surface against the base, as a tangent
    double bend = 0;              ///< |height x curvature|, with the larger principal curvature
    Vec3d n_u{0}, n_v{0};         ///< changes of n from one texel to the next
};

/// Derivatives are those of the triangles, so that the shape needs none.
class ReliefPoints {
public:
    /// The scene and the height, which may be null, must outlive this object.
    ReliefPoints(const Scene& scene, std::uint32_t instance, const HeightTexture* relief, const HeightOptions& options);

    std::int64_t triangles() const noexcept { return std::int64_t(surface_.triangles.size()); }
    Vec3d world(const Vec3d& p) const noexcept { return linear_ * p + translate_; }
    /// Nothing where the shape has no normal. Without uvs the relief is 0.
    std::optional<ReliefPoint> at(std::uint32_t triangle, double b1, double b2) const noexcept;

private:
    Height<double> height_at(const Vec2d& uv) const noexcept;

    const Instance& instance_;
    const MeshSurface& surface_;
    const HeightTexture* relief_;
    HeightOptions options_;
    std::optional<SlopeFilter<float>> slopes_;
    Vec2d scale_{0};
    glm::dmat3 linear_, normals_;
    Vec3d translate_;
};

} // namespace bake
