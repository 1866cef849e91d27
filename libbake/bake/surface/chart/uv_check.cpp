#include "bake/surface/chart/uv_check.h"
#include "bake/surface/chart/uv_raster.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

struct AreaSample {
    double value, area;
};

/// The value below which `share` of the total area lies. The samples are sorted by value.
double percentile(const std::vector<AreaSample>& sorted, double total, double share) {
    double sum = 0;
    for (const AreaSample& s : sorted)
        if ((sum += s.area) >= share * total) return s.value;
    return sorted.empty() ? 0 : sorted.back().value;
}

Spread spread(std::vector<AreaSample>& samples) {
    std::sort(samples.begin(), samples.end(),
              [](const AreaSample& a, const AreaSample& b) { return a.value < b.value; });
    double total = 0;
    for (const AreaSample& s : samples) total += s.area;
    return {percentile(samples, total, 0.05), percentile(samples, total, 0.5), percentile(samples, total, 0.95)};
}

bool has_uv(const Mesh& mesh, const Triangle& t) noexcept {
    return std::all_of(t.corner.begin(), t.corner.end(),
                       [&](std::uint32_t c) { return mesh.corner_uv[c] != no_index; });
}

/// Larger over smaller singular value of the linear map from the uv triangle to the triangle in space, which have areas.
double stretch(Vec2d a, Vec2d b, double uv_cross, Vec3d p, Vec3d q) noexcept {
    const Vec3d p_u = (b.y * p - a.y * q) / uv_cross, p_v = (a.x * q - b.x * p) / uv_cross;
    const double e = glm::dot(p_u, p_u), f = glm::dot(p_u, p_v), g = glm::dot(p_v, p_v);
    const double larger = 0.5 * (e + g) + std::hypot(0.5 * (e - g), f); // squared
    return larger / glm::length(glm::cross(p_u, p_v)); // the product of both values; e g - f f would cancel
}

void measure_triangles(const Mesh& mesh, const std::vector<Triangle>& triangles, double zero_area, UvCheck& check) {
    const double diagonal2 = glm::dot(check.max - check.min, check.max - check.min);
    std::vector<AreaSample> density, stretches;
    for (const Triangle& t : triangles) {
        if (!has_uv(mesh, t)) continue;
        ++check.triangles;
        Vec2d uv[3];
        Vec3d p[3];
        for (int k = 0; k < 3; ++k) {
            uv[k] = Vec2d(mesh.uvs[mesh.corner_uv[t.corner[k]]]);
            p[k] = Vec3d(mesh.positions[mesh.corner_position[t.corner[k]]]);
        }
        const Vec2d a = uv[1] - uv[0], b = uv[2] - uv[0];
        const double uv_cross = a.x * b.y - a.y * b.x;
        if (0.5 * std::abs(uv_cross) <= zero_area * diagonal2) {
            ++check.degenerate_triangles;
            continue;
        }
        check.mirrored_triangles += uv_cross < 0;
        const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        if (!(area > 0)) continue;
        density.push_back({std::sqrt(0.5 * std::abs(uv_cross) / area), area});
        stretches.push_back({stretch(a, b, uv_cross, p[1] - p[0], p[2] - p[0]), area});
    }
    check.density = spread(density);
    if (check.density.median > 0) {
        check.density.p5 /= check.density.median;
        check.density.p95 /= check.density.median;
    }
    check.stretch = spread(stretches);
}

constexpr int udim_columns = 10, udim_rows = 900; // 1001 to 9999

void find_tiles(const Mesh& mesh, UvCheck& check) {
    std::vector<char> used(udim_columns * udim_rows, 0);
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const TileRange range = tiles_of_face(mesh, f);
        if (range.empty) continue;
        const auto [first, last] = std::pair(range.first, range.last);
        check.crossing_faces += first != last;
        check.outside_faces += first.u < 0 || first.v < 0 || last.u >= udim_columns || last.v >= udim_rows;
        for (int v = std::clamp(first.v, 0, udim_rows); v <= std::min(last.v, udim_rows - 1); ++v)
            for (int u = std::clamp(first.u, 0, udim_columns); u <= std::min(last.u, udim_columns - 1); ++u)
                used[v * udim_columns + u] = 1;
    }
    for (int tile = 0; tile < udim_columns * udim_rows; ++tile)
        if (used[tile]) check.udim_tiles.push_back(1001 + tile);
}

/// The charts are scaled to the unit square together and sampled there.
void measure_overlap(const Mesh& mesh, const std::vector<Triangle>& triangles, int size, UvCheck& check) {
    const Vec2d extent = check.max - check.min;
    if (size <= 0 || !(extent.x > 0) || !(extent.y > 0)) return;
    Mesh charts;
    charts.positions = mesh.positions;
    charts.face_begin = mesh.face_begin;
    charts.corner_position = mesh.corner_position;
    charts.corner_uv = mesh.corner_uv;
    charts.uvs.reserve(mesh.uvs.size());
    for (const Vec2f& uv : mesh.uvs) charts.uvs.push_back(Vec2f((Vec2d(uv) - check.min) / extent));
    const auto samples = [size](double tiles) {
        return std::clamp(int(std::ceil(size * std::min(tiles, 2.0))), 16, 2 * size);
    };
    const int width = samples(extent.x), height = samples(extent.y);
    const UvRaster raster = uv_raster(charts, triangles, width, height);
    check.covered = extent.x * extent.y * double(raster.covered) / (double(width) * height);
    if (raster.covered > 0) check.overlap = double(raster.overlapped) / double(raster.covered);
}

} // namespace

UvCheck check_uvs(const Mesh& mesh, const std::vector<Triangle>& triangles, const UvCheckOptions& options) {
    UvCheck check;
    bool any = false;
    for (const std::uint32_t i : mesh.corner_uv) {
        if (i == no_index) continue;
        const Vec2d uv(mesh.uvs[i]);
        check.min = any ? Vec2d(std::min(check.min.x, uv.x), std::min(check.min.y, uv.y)) : uv;
        check.max = any ? Vec2d(std::max(check.max.x, uv.x), std::max(check.max.y, uv.y)) : uv;
        any = true;
    }
    if (!any) return check;
    measure_triangles(mesh, triangles, options.zero_area, check);
    find_tiles(mesh, check);
    check.tiles = uv_tiles(mesh, triangles, options.overlap_size);
    measure_overlap(mesh, triangles, options.overlap_size, check);
    return check;
}

} // namespace bake
