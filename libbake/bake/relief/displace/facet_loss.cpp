#include "bake/relief/displace/facet_loss.h"
#include "bake/base/parallel.h"
#include "bake/relief/map/relief_points.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace bake {
namespace {

constexpr std::int64_t points = 65536;

/// Sums over points, each weighted by the area in uv that it stands for.
struct Sums {
    double weight = 0, square = 0, height = 0, height_square = 0, largest = 0;
    double edges = 0, texels = 0;
};

/// The height at a uv, bilinear: a sampler would copy the picture.
double height_at(const Relief& relief, const Vec2d& uv) noexcept {
    const Image<float>& values = relief.values;
    const Vec2d texel(1.0 / values.width(), 1.0 / values.height());
    const double x = uv.x * values.width() - 0.5, y = uv.y * values.height() - 0.5;
    const double right = x - std::floor(x), up = y - std::floor(y);
    const Vec2d low = Vec2d(std::floor(x) + 0.5, std::floor(y) + 0.5) * texel;
    const auto value = [&](int i, int j) {
        const auto [column, row] = texel_at(values, low + Vec2d(i, j) * texel, relief.height);
        return double(values.at(column, row));
    };
    const double mean = (1 - up) * ((1 - right) * value(0, 0) + right * value(1, 0)) +
                        up * ((1 - right) * value(0, 1) + right * value(1, 1));
    return relief.height.amplitude * (mean - relief.height.midlevel);
}

void add_triangle(const Relief& relief, const std::array<Vec2d, 3>& uv, std::int64_t first, std::int64_t count,
                  Sums& sums) {
    const Vec2d d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    const double weight = std::abs(d1.x * d2.y - d2.x * d1.y) / double(count);
    std::array<double, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = height_at(relief, uv[k]);
    for (std::int64_t i = first; i < first + count; ++i) {
        const Vec2d b = even_barycentrics(i), at = uv[0] + b.x * d1 + b.y * d2;
        const double h = height_at(relief, at);
        const double off = std::abs(h - ((1 - b.x - b.y) * corner[0] + b.x * corner[1] + b.y * corner[2]));
        sums.weight += weight, sums.square += weight * off * off;
        sums.height += weight * h, sums.height_square += weight * h * h;
        sums.largest = std::max(sums.largest, off);
    }
}

void add_face(const Mesh& mesh, const Relief& relief, std::size_t face, std::int64_t per_face, Sums& sums) {
    const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
    for (std::uint32_t c = begin; c < end; ++c)
        if (mesh.corner_uv[c] == no_index) return;
    const auto uv = [&](std::uint32_t c) { return Vec2d(mesh.uvs[mesh.corner_uv[c]]); };
    const Vec2d texels(relief.values.width(), relief.values.height());
    for (std::uint32_t c = begin; c < end; ++c, ++sums.edges)
        sums.texels += glm::length((uv(c + 1 < end ? c + 1 : begin) - uv(c)) * texels);
    const std::int64_t triangles = end - begin - 2, count = std::max<std::int64_t>(1, per_face / triangles);
    for (std::uint32_t c = begin + 1; c + 1 < end; ++c)
        add_triangle(relief, {uv(begin), uv(c), uv(c + 1)}, (std::int64_t(face) + c) * count, count, sums);
}

void merge(const Sums& part, Sums& sums) {
    sums.weight += part.weight, sums.square += part.square;
    sums.height += part.height, sums.height_square += part.height_square;
    sums.largest = std::max(sums.largest, part.largest);
    sums.edges += part.edges, sums.texels += part.texels;
}

} // namespace

FacetLoss facet_loss(const Mesh& displaced, const Relief& relief) {
    const auto faces = std::int64_t(displaced.faces());
    if (relief.vector || faces == 0 || displaced.corner_uv.empty()) return {};
    const std::int64_t sampled = std::min(faces, points), per_face = points / sampled;
    constexpr std::int64_t block = 256;
    std::vector<Sums> blocks(std::size_t((sampled + block - 1) / block));
    for_rows(std::int64_t(blocks.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin * block; i < std::min(end * block, sampled); ++i)
            add_face(displaced, relief, std::size_t(i * faces / sampled), per_face, blocks[std::size_t(i / block)]);
    });
    Sums sums;
    for (const Sums& part : blocks) merge(part, sums);
    if (!(sums.weight > 0)) return {};
    const double mean = sums.height / sums.weight;
    return {.rms = std::sqrt(sums.square / sums.weight),
            .max = sums.largest,
            .relief = std::sqrt(std::max(0.0, sums.height_square / sums.weight - mean * mean)),
            .edge_texels = sums.texels / sums.edges};
}

} // namespace bake
