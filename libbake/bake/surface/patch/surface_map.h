// Maps of a surface over its uv chart: what lies under the centre of each texel, in raw object units.
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
/// As the command line and the files' names have it: "position", "pu", "mean-curvature".
const char* name(MapQuantity quantity) noexcept;
/// 3, 4 for tangents, 1 for curvatures.
int channels(MapQuantity quantity) noexcept;

struct SurfaceMapOptions {
    int width = 1024, height = 1024; ///< texels
    int padding = 16;                ///< texels filled beyond the charts' borders
};

struct SurfaceMapReport {
    std::int64_t covered = 0;    ///< texels whose centre lies on the surface's chart
    std::int64_t border = 0;     ///< texels that a chart touches: the nearest point of it
    std::int64_t overlapped = 0; ///< texels whose centre lies in more than one face: the lowest was taken
    std::int64_t degenerate = 0; ///< texels on a pole or without chart: what does not exist there is padded
    std::int64_t padded = 0;     ///< empty texels filled from the nearest chart
    std::int64_t empty = 0;      ///< texels left at zero
    std::int64_t outside_faces = 0, crossing_faces = 0; ///< of the mesh, as UvRaster
    double residual = 0; ///< largest distance in uv between a covered texel's centre and the point taken
};

/// One image per quantity. The mesh finds the patch under each texel; on limit surfaces, whose uvs are no linear
/// function of the patch's parameters, Newton's method then finds the parameters, across edges where it must.
/// Throws Error{Refusal::unsuitable}, naming `path`, for a surface without uvs or none in the unit square.
std::vector<Image<float>> surface_maps(const BaseSurface& surface, const SurfaceMesh& mesh,
                                       std::span<const MapQuantity> quantities, const SurfaceMapOptions& options,
                                       const std::string& path, SurfaceMapReport& report, Progress* progress = nullptr);

} // namespace bake
