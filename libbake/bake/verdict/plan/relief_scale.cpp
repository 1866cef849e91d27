#include "bake/verdict/plan/relief_scale.h"
#include <cmath>
#include <limits>

namespace bake {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The wavelength of a sine whose difference quotients over one texel have the ratio `ratio` to its values: the ratio is
/// 2 sin(pi / wavelength).
double wavelength(double ratio) noexcept {
    if (!(ratio > 0)) return infinite;
    return ratio >= 2 ? 2 : pi / std::asin(ratio / 2);
}

} // namespace

double dominant_wave(const Image<float>& height) {
    const int w = height.width(), h = height.height();
    double mean = 0;
    for (std::size_t i = 0; i < height.size(); ++i) mean += height.data()[i];
    mean /= double(height.size());
    double values = 0, slopes = 0;
    for (int y = 0; y < h; ++y) {
        const float *row = height.row(y), *next = height.row((y + 1) % h);
        for (int x = 0; x < w; ++x) {
            const double b = row[x], b_u = row[(x + 1) % w] - b, b_v = next[x] - b;
            values += (b - mean) * (b - mean);
            slopes += b_u * b_u + b_v * b_v;
        }
    }
    // Rounding makes a flat height vary a little.
    if (values <= 1e-12 * mean * mean * double(height.size())) return infinite;
    return wavelength(std::sqrt(slopes / values));
}

double edge_texels(const Shape& shape, int width, int height) {
    const Mesh& mesh = shape.mesh;
    if (mesh.corner_uv.empty()) return 0;
    double sum = 0;
    std::int64_t count = 0;
    for (const Triangle& triangle : shape.surface.triangles) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.corner_uv[triangle.corner[std::size_t(k)]];
            const std::uint32_t b = mesh.corner_uv[triangle.corner[std::size_t((k + 1) % 3)]];
            if (a == no_index || b == no_index) continue;
            const Vec2d d = Vec2d(mesh.uvs[b] - mesh.uvs[a]) * Vec2d(width, height);
            sum += glm::dot(d, d);
            ++count;
        }
    }
    return count > 0 ? std::sqrt(sum / double(count)) : 0;
}

} // namespace bake
