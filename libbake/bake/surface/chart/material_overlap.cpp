#include "bake/surface/chart/material_overlap.h"
#include "bake/surface/chart/uv_tiles.h"
#include <map>

namespace bake {
namespace {

constexpr int samples = 512;
constexpr Vec2d place(0.437, 0.571); // of a texel: no edge of a chart is likely to pass through it
constexpr int band_rows = PlaceRaster::band_rows;

/// Goes over the points that the triangles cover; calls visit(point).
template <class Visit> void for_covered(const Mesh& mesh, const std::vector<Triangle>& triangles, const Visit& visit) {
    const PlaceRaster raster(mesh, triangles, samples, samples);
    std::vector<TexelHit> hits(std::size_t(band_rows) * samples);
    for (int band = 0; band < raster.bands(); ++band) {
        raster.band(band, place, hits);
        for (std::size_t i = 0; i < hits.size(); ++i)
            if (hits[i].triangle != no_index) visit(std::size_t(band) * hits.size() + i);
    }
}

} // namespace

std::vector<std::string> overlapping_materials(const Mesh& mesh, const std::vector<Triangle>& triangles, int size,
                                               int tile, const std::string& path) {
    static_assert(samples % band_rows == 0);
    if (mesh.materials.size() < 2 || mesh.face_material.empty()) return {};
    const PlacedCharts charts = place_charts(mesh, triangles, tile, size, path);
    std::map<std::uint32_t, std::vector<Triangle>> of_material;
    for (std::size_t t = 0; t < charts.triangles->size(); ++t) {
        const Triangle& given = triangles[charts.source.empty() ? t : charts.source[t]];
        if (const std::uint32_t material = mesh.face_material[given.face]; material != no_index)
            of_material[material].push_back((*charts.triangles)[t]);
    }
    std::vector<std::uint32_t> first(std::size_t(samples) * samples, no_index); // material of each point
    std::vector<bool> overlaps(mesh.materials.size());
    for (const auto& [material, own] : of_material)
        for_covered(*charts.mesh, own, [&, m = material](std::size_t point) {
            if (first[point] == no_index) first[point] = m;
            else overlaps[first[point]] = overlaps[m] = true;
        });
    std::vector<std::string> names;
    for (std::size_t m = 0; m < overlaps.size(); ++m)
        if (overlaps[m]) names.push_back(mesh.materials[m]);
    return names;
}

} // namespace bake
