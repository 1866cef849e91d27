#include "bake/surface/patch/surface_map.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/picture/pad_texels.h"
#include "bake/surface/chart/uv_tiles.h"
#include "bake/surface/patch/patch_locator.h"
#include <algorithm>
#include <atomic>
#include <glm/common.hpp>

namespace bake {

const char* name(MapQuantity quantity) noexcept {
    switch (quantity) {
    case MapQuantity::position: return "position";
    case MapQuantity::normal: return "normal";
    case MapQuantity::p_u: return "pu";
    case MapQuantity::p_v: return "pv";
    case MapQuantity::tangent: return "tangent";
    case MapQuantity::mean_curvature: return "mean-curvature";
    default: return "gauss-curvature";
    }
}

int channels(MapQuantity quantity) noexcept {
    if (quantity == MapQuantity::mean_curvature || quantity == MapQuantity::gauss_curvature) return 1;
    return quantity == MapQuantity::tangent ? 4 : 3;
}

namespace {

constexpr double on_chart = 1e-9; ///< uv: largest distance of a covered texel's centre from the point found

void write(MapQuantity quantity, const SurfaceValues& s, float* to) noexcept {
    const auto put = [&](const Vec3d& v) { to[0] = float(v.x), to[1] = float(v.y), to[2] = float(v.z); };
    switch (quantity) {
    case MapQuantity::position: put(s.p); break;
    case MapQuantity::normal: put(s.n); break;
    case MapQuantity::p_u: put(s.p_u); break;
    case MapQuantity::p_v: put(s.p_v); break;
    case MapQuantity::tangent: put(unit_or_zero(s.p_u - glm::dot(s.p_u, s.n) * s.n)), to[3] = float(s.sigma); break;
    case MapQuantity::mean_curvature: to[0] = float(s.mean_curvature); break;
    case MapQuantity::gauss_curvature: to[0] = float(s.gauss_curvature); break;
    }
}

/// How much of a point exists, and how much a quantity needs to exist for a texel to show it.
enum Level : unsigned char { nothing, point, normal, curvature, everything };
Level level_of(Degenerate degenerate) noexcept {
    switch (degenerate) {
    case Degenerate::none: return everything;
    case Degenerate::no_chart: return curvature;
    case Degenerate::pole: return normal;
    default: return point;
    }
}
Level needed(MapQuantity quantity) noexcept {
    switch (quantity) {
    case MapQuantity::position: return point;
    case MapQuantity::normal: return normal;
    case MapQuantity::mean_curvature:
    case MapQuantity::gauss_curvature: return curvature;
    default: return everything;
    }
}
Image<unsigned char> owners(const Image<unsigned char>& level, Level least) {
    Image<unsigned char> out(level.width(), level.height(), 1);
    std::transform(level.data(), level.data() + level.size(), out.data(),
                   [&](unsigned char has) { return has >= least; });
    return out;
}

/// Finds the point of the surface at a texel.
class TexelFinder {
public:
    TexelFinder(const BaseSurface& surface, const SurfaceMesh& mesh)
        : surface_(surface), mesh_(mesh), locator_(surface) {}

    /// `hit` is the point of the mesh at the texel's centre, or nearest to it; it may lie in another tile than the texel.
    Located find(const TexelHit& hit, const Vec2d& texel_centre) const noexcept {
        const TrianglePlace& place = mesh_.places[hit.triangle];
        const double b1 = hit.b1, b2 = hit.b2;
        const auto mix = [&](const Vec2d& a, const Vec2d& b, const Vec2d& c) {
            return (1 - b1 - b2) * a + b1 * b + b2 * c;
        };
        const Vec2d st = mix(place.st[0], place.st[1], place.st[2]);
        const Mesh& mesh = mesh_.mesh;
        const Triangle& triangle = mesh_.triangles[hit.triangle];
        const auto uv = [&](std::uint32_t corner) { return Vec2d(mesh.uvs[mesh.corner_uv[corner]]); };
        const Vec2d target = mix(uv(triangle.corner[0]), uv(triangle.corner[1]), uv(triangle.corner[2]));
        const Vec2d centre = texel_centre + glm::round(target - texel_centre);
        if (mesh_.kind != SurfaceKind::mesh) return locator_.locate(centre, place.patch, st);

        Located at{place.patch, st, {}, 0};
        const std::uint32_t first = mesh.face_begin[triangle.face];
        if (mesh.face_begin[triangle.face + 1] - first == 4) {
            const Vec2d corners[4] = {uv(first), uv(first + 1), uv(first + 2), uv(first + 3)};
            at.st = invert_bilinear(corners, target, st);
        }
        surface_.evaluate(at.patch, {&at.st, 1}, {&at.point, 1});
        at.residual = glm::length(centre - at.point.uv);
        return at;
    }

private:
    const BaseSurface& surface_;
    const SurfaceMesh& mesh_;
    PatchLocator locator_;
};

} // namespace

std::vector<Image<float>> surface_maps(const BaseSurface& surface, const SurfaceMesh& mesh,
                                       std::span<const MapQuantity> quantities, const SurfaceMapOptions& options,
                                       const std::string& path, SurfaceMapReport& report, Progress* progress) {
    if (mesh.mesh.corner_uv.empty())
        throw Error(Refusal::unsuitable, path + ": has no uvs, which maps need; unwrap the mesh first");
    const int width = options.width, height = options.height;
    const UvRaster raster = chart_raster(mesh.mesh, mesh.triangles, width, height, options.tile, path);
    std::vector<Image<float>> maps;
    for (const MapQuantity q : quantities) maps.emplace_back(width, height, channels(q));
    Image<unsigned char> level(width, height, 1);
    const TexelFinder finder(surface, mesh);
    // On a mesh the uvs are floats, which limits how near to the centre the point can be.
    const double tolerance = mesh.kind == SurfaceKind::mesh ? 1e-6 : on_chart;
    std::atomic<std::int64_t> covered{0}, border{0}, degenerate{0};
    std::vector<double> residuals(std::size_t(height), 0.0);
    for_rows(
        height, 4,
        [&](std::int64_t begin, std::int64_t end) {
            std::int64_t covered_here = 0, border_here = 0, degenerate_here = 0;
            for (auto y = int(begin); y < int(end); ++y)
                for (int x = 0; x < width; ++x) {
                    const TexelHit& hit = raster.hits.at(x, y);
                    SurfaceValues values;
                    const bool here = hit.triangle != no_index;
                    if (here) {
                        const Vec2d centre((x + 0.5) / width, 1 - (y + 0.5) / height);
                        const Located at = finder.find(hit, centre);
                        values = surface_values(at.point, true);
                        const bool inside = at.residual <= tolerance;
                        ++(inside ? covered_here : border_here);
                        double& worst = residuals[std::size_t(y)];
                        if (inside) worst = std::max(worst, at.residual);
                        degenerate_here += values.degenerate != Degenerate::none;
                    }
                    level.at(x, y) = here ? level_of(values.degenerate) : nothing;
                    for (std::size_t q = 0; q < maps.size(); ++q) write(quantities[q], values, &maps[q].at(x, y));
                }
            covered += covered_here, border += border_here, degenerate += degenerate_here;
        },
        progress);
    report = {.covered = covered,
              .border = border,
              .overlapped = raster.overlapped,
              .degenerate = degenerate,
              .outside_faces = raster.outside_faces,
              .crossing_faces = raster.crossing_faces,
              .tiles = raster.tiles,
              .residual = *std::max_element(residuals.begin(), residuals.end())};
    Image<float> scratch(width, height, 1);
    std::fill_n(scratch.data(), scratch.size(), 0.0f);
    report.padded = pad_texels(scratch, owners(level, point), options.padding);
    for (std::size_t q = 0; q < maps.size(); ++q)
        pad_texels(maps[q], owners(level, needed(quantities[q])), options.padding);
    report.empty = std::int64_t(width) * height - report.covered - report.border - report.padded;
    return maps;
}

} // namespace bake
