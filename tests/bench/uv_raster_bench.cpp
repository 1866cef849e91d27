// uv_raster_bench: time and error of uv_raster. The error is the distance in uv from the hit's point to the texel's
// centre, on a chart that wraps 360 degrees, over all texels whose centre lies in the chart.
// size counts texels along a side; ratio is the time over that of writing as many hits once, on as many threads.
#include "bake/surface/chart/uv_raster.h"
#include "bench.h"
#include <glm/common.hpp>

using namespace bake;

namespace {

struct Chart {
    Mesh mesh;
    std::vector<Triangle> triangles;
    double margin; // to the sides of the unit square
};

// A sheet of cells x cells quads within the unit square, its inner points shifted, each quad in two triangles.
Chart sheet(int cells, double margin) {
    Chart chart;
    chart.margin = margin;
    Mesh& mesh = chart.mesh;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const bool inner = i > 0 && j > 0 && i < cells && j < cells;
            const double du = inner ? 0.3 * std::sin(i * 12.9 + j * 78.2) : 0;
            const double dv = inner ? 0.3 * std::sin(i * 39.3 + j * 11.1) : 0;
            mesh.uvs.emplace_back(margin + (1 - 2 * margin) * (i + du) / cells,
                                  margin + (1 - 2 * margin) * (j + dv) / cells);
            mesh.positions.emplace_back(mesh.uvs.back(), 0);
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const std::uint32_t at = std::uint32_t(j * (cells + 1) + i), up = at + std::uint32_t(cells) + 1;
            for (const std::uint32_t k : {at, at + 1, up + 1, at, up + 1, up}) {
                mesh.corner_position.push_back(k);
                mesh.corner_uv.push_back(k);
                if (mesh.corner_uv.size() % 3) continue;
                const std::uint32_t end = std::uint32_t(mesh.corner_uv.size());
                chart.triangles.push_back({{end - 3, end - 2, end - 1}, std::uint32_t(mesh.faces())});
                mesh.face_begin.push_back(end);
            }
        }
    return chart;
}

bench::Errors errors_of(const Chart& chart, const UvRaster& raster) {
    const int size = raster.hits.width();
    std::vector<float> errors;
    for (int y = 0; y < size; y += 3)
        for (int x = 0; x < size; x += 3) {
            const TexelHit hit = raster.hits.at(x, y);
            const Vec2d centre((x + 0.5) / size, 1 - (y + 0.5) / size);
            const Vec2d to_edge = glm::abs(centre - 0.5);
            if (std::max(to_edge.x, to_edge.y) > 0.5 - chart.margin) continue;
            if (hit.triangle == no_index) {
                errors.push_back(360); // a hole
                continue;
            }
            Vec2d uv[3];
            for (int k = 0; k < 3; ++k)
                uv[k] = chart.mesh.uvs[chart.mesh.corner_uv[chart.triangles[hit.triangle].corner[k]]];
            const Vec2d found = uv[0] + double(hit.b1) * (uv[1] - uv[0]) + double(hit.b2) * (uv[2] - uv[0]);
            errors.push_back(float(glm::length(found - centre) * 360));
        }
    return bench::errors_of(std::move(errors));
}

void row(const std::string& name, const Chart& chart, int size, int threads) {
    const ThreadLimit limit(threads);
    std::int64_t covered = 0, border = 0, overlapped = 0;
    const auto turns =
        bench::in_turn(3, {[&] {
                           Image<TexelHit> plain(size, size, 1);
                           for_rows(size, 16, [&](std::int64_t begin, std::int64_t end) {
                               std::fill(plain.row(int(begin)), plain.row(int(begin)) + (end - begin) * size,
                                         TexelHit{no_index, 0, 0});
                           });
                       }},
                       {{[&] { return uv_raster(chart.mesh, chart.triangles, size, size); },
                         [&](const UvRaster& raster) {
                             covered = raster.covered, border = raster.border, overlapped = raster.overlapped;
                             return errors_of(chart, raster);
                         }}});
    const bench::Measured& ours = turns.works[0];
    bench::print_row(ours, {"uv_raster", name, size, double(size) * size, ours.ratio_to(turns.limits[0]), "write pass",
                            bench::text("%zu triangles; median %.0f ms; covered %lld border %lld overlapped %lld",
                                        chart.triangles.size(), ours.median() * 1e3, static_cast<long long>(covered),
                                        static_cast<long long>(border), static_cast<long long>(overlapped))});
}

} // namespace

int main() {
    const Chart few = sheet(4, 0.01), many = sheet(224, 0.01), fine = sheet(1000, 0.01);
    for (const int threads : {1, 2}) {
        row("32_triangles", few, 4096, threads);
        row("100k_triangles", many, 4096, threads);
        row("2M_triangles", fine, 4096, threads);
    }
}
