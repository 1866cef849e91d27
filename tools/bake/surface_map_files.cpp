#include "surface_map_files.h"
#include "bake/base/parallel.h"
#include "inputs/name_list.h"

namespace bake {
namespace {

std::vector<std::string> channel_names(MapQuantity quantity) {
    if (channels(quantity) == 1) return {"Y"};
    if (channels(quantity) == 3) return {"R", "G", "B"};
    return {"R", "G", "B", "sign"};
}

} // namespace

std::vector<MapQuantity> parse_maps(const std::string& text) {
    std::vector<std::string> known;
    for (const MapQuantity q : all_map_quantities) known.emplace_back(name(q));
    std::vector<MapQuantity> out;
    for (const std::size_t i : parse_names("--maps", text, "map", known)) out.push_back(all_map_quantities[i]);
    return out;
}

std::string map_file(const std::string& prefix, MapQuantity quantity) { return prefix + "_" + name(quantity) + ".exr"; }

std::vector<std::unique_ptr<ImageWriter>> open_maps(const std::string& prefix,
                                                    const std::vector<MapQuantity>& quantities,
                                                    const SurfaceMapOptions& options) {
    std::vector<std::unique_ptr<ImageWriter>> writers;
    for (const MapQuantity q : quantities)
        writers.push_back(std::make_unique<ImageWriter>(
            map_file(prefix, q), options.width, options.height, channels(q),
            WriteOptions{.depth = Depth::float32,
                         .channels = channel_names(q),
                         .facts = {{"content", std::string(name(q))}, {"units", std::string("object units")}}}));
    return writers;
}

void write_maps(std::vector<std::unique_ptr<ImageWriter>>& writers, const std::vector<Image<float>>& maps) {
    for_rows(std::int64_t(maps.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (auto q = std::size_t(begin); q < std::size_t(end); ++q) {
            writers[q]->write(maps[q].data(), maps[q].height());
            writers[q]->finish();
        }
    });
}

} // namespace bake
