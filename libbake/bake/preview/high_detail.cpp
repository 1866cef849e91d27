#include "bake/preview/high_detail.h"
#include "bake/base/text.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/preview/scene_positions.h"
#include "bake/preview/texture_size.h"
#include "bake/relief/transfer/reach.h"
#include "bake/relief/transfer/transfer.h"
#include <algorithm>

namespace bake {
namespace {

constexpr double noted_misses = 0.001; ///< share of the texels in charts

void note_misses(const HighEntry& high, const TransferReport& report, std::vector<std::string>& notes) {
    const double share = double(report.missed) / double(std::max<std::int64_t>(1, report.hit + report.missed));
    if (share > noted_misses)
        notes.push_back(format("%s: %.2g %% of the texels of the normal map find no detail of it; does it lie on the "
                               "low-poly mesh?",
                               high.file.c_str(), 100 * share));
}

} // namespace

int detail_rays(int size) noexcept { return std::clamp(1024 / size, 1, 16); }

Texture high_normal_map(const HighEntry& high, const Mesh& low, const std::string& name,
                        std::vector<std::string>& notes) {
    Mesh detail = read_mesh(high.file);
    make_absolute(detail, high.file, notes);
    TransferOptions options;
    options.width = options.height = high.size;
    options.rays = detail_rays(high.size);
    std::vector<HighMesh> meshes;
    meshes.push_back({std::move(detail), high.file});
    const BakeTarget target = make_bake_target(low, name, high.size, high.size);
    const double rays = double(high.size) * high.size * options.rays * options.rays;
    const HighSurface surface(std::move(meshes), low.origin, HighNormals::smooth, rays);
    const Casting casting(target.surface, CastBy::blend, measured_reach(target.surface, surface));
    Transfer baked = transfer(target, surface, casting, options, name);
    note_misses(high, baked.report, notes);
    for (std::size_t i = 0; i < baked.map.size(); ++i) baked.map.data()[i] = 2 * baked.map.data()[i] - 1;
    const auto map = std::make_shared<const Image<float>>(std::move(baked.map));
    return high.normal_bc5 ? normals_in_bc5(map) : map;
}

} // namespace bake
