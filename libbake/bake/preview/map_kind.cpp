#include "bake/preview/map_kind.h"
#include "bake/relief/height/picture_kind.h"
#include "bake/relief/map/slope_code.h"
#include <algorithm>

namespace bake {

MapKind guess_map_kind(const Image<float>& image, const ImageInfo& info) {
    const auto has = [&](const char* channel) {
        return std::find(info.channels.begin(), info.channels.end(), channel) != info.channels.end();
    };
    if (slope_code(info.description) || (has("b_u") && has("b_v"))) return MapKind::bump;
    switch (guess_kind(image, info).looks) {
    case Looks::normal_map: return MapKind::normal;
    case Looks::constant:
    case Looks::grey: return MapKind::height;
    case Looks::data: return image.channels() == 2 ? MapKind::bump : MapKind::colour;
    case Looks::colour: break;
    }
    return MapKind::colour;
}

const char* name(MapKind kind) noexcept {
    switch (kind) {
    case MapKind::normal: return "a normal map";
    case MapKind::bump: return "a bump table";
    case MapKind::height: return "a height";
    case MapKind::colour: return "a colour texture";
    case MapKind::automatic: break;
    }
    return "a map";
}

} // namespace bake
