#include "bake/relief/map/relief_points.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr std::int64_t least_points = 65536;

/// A texel of n at a texture coordinate.
int texel(double u, int n, Wrap wrap) noexcept {
    const double at = std::floor(u * n);
    if (wrap == Wrap::clamp) return int(std::clamp(at, 0.0, n - 1.0));
    return wrap_index(int(std::fmod(at, 2.0 * n)), n, wrap);
}

} // namespace

Vec2d even_barycentrics(std::int64_t i) noexcept {
    // Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018.
    const double b1 = std::fmod(0.5 + 0.7548776662466927 * double(i), 1.0);
    const double b2 = std::fmod(0.5 + 0.5698402909980532 * double(i), 1.0);
    return b1 + b2 > 1 ? Vec2d(1 - b1, 1 - b2) : Vec2d(b1, b2);
}

std::pair<int, int> texel_at(const Image<float>& values, const Vec2d& uv, const HeightOptions& options) noexcept {
    return {texel(uv.x, values.width(), options.wrap_u), texel(1 - uv.y, values.height(), options.wrap_v)};
}

ReliefPoints::ReliefPoints(const MeshSurface& surface, const HeightTexture& height, Filter filter,
                           const HeightOptions& options)
    : surface_(surface), values_(height.values), options_(options),
      slopes_(height.values, filter, options.wrap_u, options.wrap_v),
      count_(surface.triangles.empty()
                 ? 0
                 : std::clamp(std::int64_t(surface.triangles.size()), least_points, 4 * least_points)) {}

std::uint32_t ReliefPoints::triangle(std::int64_t i) const noexcept {
    return std::uint32_t(i * std::int64_t(surface_.triangles.size()) / count_);
}

std::optional<MethodSample> ReliefPoints::at(std::int64_t i) const noexcept {
    const Vec2d even = even_barycentrics(i);
    const double b1 = even.x, b2 = even.y;
    const std::uint32_t own = triangle(i);
    const Jet<double> jet = jet_at<double>(surface_, own, b1, b2);
    if (jet.sigma == 0) return {};
    const Mesh& mesh = *surface_.mesh;
    const auto& corner = surface_.triangles[own].corner;
    const auto uv_of = [&](int k) { return Vec2d(mesh.uvs[mesh.corner_uv[corner[k]]]); };
    const Vec2d uv = (1 - b1 - b2) * uv_of(0) + b1 * uv_of(1) + b2 * uv_of(2);
    const auto [x, y] = texel_at(values_, uv, options_);
    const Vec2d scale = options_.amplitude * Vec2d(values_.width(), values_.height());
    const auto [b_u, b_v] = slopes_.at(x, y, float(scale.x), float(scale.y));
    return MethodSample{jet, {options_.amplitude * (double(values_.at(x, y)) - options_.midlevel), b_u, b_v}, uv};
}

double ReliefPoints::area(std::int64_t i) const noexcept {
    const Mesh& mesh = *surface_.mesh;
    const auto& corner = surface_.triangles[triangle(i)].corner;
    const auto p = [&](int k) { return Vec3d(mesh.positions[mesh.corner_position[corner[k]]]); };
    return 0.5 * glm::length(glm::cross(p(1) - p(0), p(2) - p(0)));
}

} // namespace bake
