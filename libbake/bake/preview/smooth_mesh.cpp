#include "bake/preview/smooth_mesh.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/weld.h"
#include "bake/surface/patch/surface_mesh.h"

namespace bake {
namespace {

/// The power of two from 2 to 16 that gives about 100 000 faces.
int enough_segments(std::size_t faces) noexcept {
    constexpr std::size_t wanted = 100'000;
    int segments = 16;
    while (segments > 2 && faces * std::size_t(segments) * std::size_t(segments) > wanted) segments /= 2;
    return segments;
}

} // namespace

SmoothMesh limit_mesh(Mesh cage, Scheme scheme, const std::string& file, int segments) {
    if (mesh_format(file) != MeshFormat::obj) weld_positions(cage);
    check_cage(cage, scheme, file);
    const int rate = segments > 0 ? segments : enough_segments(cage.faces());
    SmoothMesh out;
    out.surface = std::make_shared<const BaseSurface>(std::move(cage), SubdivisionOptions{.scheme = scheme}, file);
    out.mesh = surface_mesh(*out.surface, SurfaceKind::limit, rate).mesh;
    return out;
}

std::shared_ptr<const BaseSurface> shape_surface(const std::string& shape, int columns, int rows) {
    if (shape == "cube" || shape.starts_with("cube:")) return nullptr;
    const ParametricSurface surface(shape);
    const auto [across, up] = surface.default_resolution();
    return std::make_shared<const BaseSurface>(surface, columns > 0 ? columns : across, rows > 0 ? rows : up);
}

} // namespace bake
