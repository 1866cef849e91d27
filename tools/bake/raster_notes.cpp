#include "raster_notes.h"
#include "bake/base/text.h"
#include "bake/base/text_line.h"
#include "bake/surface/chart/material_overlap.h"
#include <algorithm>

namespace bake {

std::string shared_map_note(const BakeTarget& target, const std::string& path, int tile) {
    if (target.raster.overlapped == 0) return "";
    const int size = std::max(target.raster.hits.width(), target.raster.hits.height());
    std::string names;
    for (const std::string& name :
         overlapping_materials(*target.surface.mesh, target.surface.triangles, size, tile, path))
        names += (names.empty() ? "" : ", ") + shown(name);
    if (names.empty()) return "";
    return path + ": the charts of the materials " + names +
           " overlap in the uvs, and the map is right for one of them alone; bake a map of each by --material";
}

std::vector<std::string> notes_of(const BakeTarget& target, const std::string& path, int tile, bool all_tiles) {
    const UvRaster& raster = target.raster;
    std::vector<std::string> out;
    const auto say = [&](std::int64_t count, const char* what) {
        if (count > 0) out.push_back(format("%s: %lld %s", path.c_str(), static_cast<long long>(count), what));
    };
    say(raster.overlapped, "texels lie in more than one face; the lowest face was baked");
    if (const std::string line = shared_map_note(target, path, tile); !line.empty()) out.push_back(line);
    if (!all_tiles) say(raster.outside_faces, "faces lie outside the tile and were not baked");
    say(raster.crossing_faces, "faces leave the tile; only their part inside was baked");
    say(raster.degenerate, "triangles have no area in uv and were not baked");
    if (!raster.tiles.empty())
        out.push_back(path + ": its charts lie in " + raster.tiles + " of the uvs' tiles and are baked modulo 1");
    return out;
}

nlohmann::json to_json(const SeamDisagreement& seams) {
    return {{"edges", seams.seams},
            {"samples", seams.samples},
            {"mean_deg", seams.mean},
            {"p95_deg", seams.percentile_95},
            {"max_deg", seams.max}};
}

} // namespace bake
