// Maps of a surface over its uv chart: the quantities at the centre of each texel, in object units.
#pragma once
#include "bake/picture/image.h"
#include "bake/surface/patch/surface_mesh.h"
#include <span>

namespace bake {

class Progress;

enum class MapQuantity {
    position,
    normal,
    p_u,
    p_v,     ///< per unit of u and v
    tangent, ///< unit, along p_u across n; fourth channel sigma, the sign of B = sigma (N x T)
    mean_curvature,
    gauss_curvature,
};
inline constexpr MapQuantity all_map_quantities[] = {
    MapQuantity::position,       MapQuantity::normal,         MapQuantity::p_u, MapQuantity::p_v, MapQuantity::tangent,
    MapQuantity::mean_curvature, MapQuantity::gauss_curvature};
/// The name in the command line and in file names: "position", "pu", "mean-curvature".
const char* name(MapQuantity quantity) noexcept;
/// 3, 4 for tangents, 1 for curvatures.
int channels(MapQuantity quantity) noexcept;

struct SurfaceMapOptions {
    int width = 1024, height = 1024; ///< texels
    int padding = 16;                ///< texels filled beyond the charts' borders
    int tile = 0;                    ///< UDIM number of the tile whose charts are shown; 0: all charts, modulo 1
};

struct SurfaceMapReport {
    std::int64_t covered = 0;    ///< texels whose centre lies on the surface's chart
    std::int64_t border = 0;     ///< texels that a chart touches; they show its nearest point
    std::int64_t overlapped = 0; ///< texels whose centre lies in more than one face; the lowest face is used
    std::int64_t degenerate = 0; ///< texels on a pole or without chart; quantities that do not exist there are padded
    std::int64_t padded = 0;     ///< empty texels filled from the nearest chart
    std::int64_t empty = 0;      ///< texels left at zero
    std::int64_t outside_faces = 0, crossing_faces = 0; ///< of the mesh, as UvRaster
    std::string tiles;                                  ///< as UvRaster
    double residual = 0; ///< largest distance in uv between the centre of a covered texel and the point shown
};

/// One image per quantity. The rasterised mesh gives the patch of each texel. On limit surfaces and shapes, where uv is not
/// linear in the parameters of the patch, Newton's method then finds the parameters, in neighbouring patches if need be.
/// Throws Error{Refusal::unsuitable}, naming `path`, for a surface without uvs and for charts that chart_raster() refuses.
std::vector<Image<float>> surface_maps(const BaseSurface& surface, const SurfaceMesh& mesh,
                                       std::span<const MapQuantity> quantities, const SurfaceMapOptions& options,
                                       const std::string& path, SurfaceMapReport& report, Progress* progress = nullptr);

} // namespace bake
