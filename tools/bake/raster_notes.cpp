#include "raster_notes.h"
#include "bake/base/text.h"

namespace bake {

std::vector<std::string> notes_of(const UvRaster& raster, const std::string& path, bool all_tiles) {
    std::vector<std::string> out;
    const auto say = [&](std::int64_t count, const char* what) {
        if (count > 0) out.push_back(format("%s: %lld %s", path.c_str(), static_cast<long long>(count), what));
    };
    say(raster.overlapped, "texels lie in more than one face; the lowest face was baked");
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
