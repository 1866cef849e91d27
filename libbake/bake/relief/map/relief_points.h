// Points spread over a mesh under a height: for errors over the whole surface, whatever its charts are.
#pragma once
#include "bake/relief/map/method_error.h"
#include "bake/surface/chart/mesh_surface.h"

namespace bake {

/// Barycentrics b1, b2 of point i of an even sequence over a triangle.
Vec2d even_barycentrics(std::int64_t i) noexcept;
/// Column and row of the texel at a uv, anywhere, with the wraps of the options.
std::pair<int, int> texel_at(const Image<float>& values, const Vec2d& uv, const HeightOptions& options) noexcept;

/// As many points as triangles, but between 65536 and four times that.
class ReliefPoints {
public:
    /// `filter` must not be automatic. The surface, which needs its derivatives, and the height must outlive this object.
    ReliefPoints(const MeshSurface& surface, const HeightTexture& height, Filter filter, const HeightOptions& options);

    std::int64_t count() const noexcept { return count_; }
    /// The jet, the height of the nearest texel and its slopes; nothing where the chart has no area. On any thread.
    std::optional<MethodSample> at(std::int64_t i) const noexcept;
    /// Area of the surface that the point stands for, up to a factor that all points share.
    double area(std::int64_t i) const noexcept;

private:
    std::uint32_t triangle(std::int64_t i) const noexcept;

    const MeshSurface& surface_;
    const Image<float>& values_;
    HeightOptions options_;
    SlopeFilter<float> slopes_;
    std::int64_t count_;
};

} // namespace bake
