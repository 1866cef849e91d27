#include "surface_map_files.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include <algorithm>

namespace bake {
namespace {

std::vector<std::string> channel_names(MapQuantity quantity) {
    if (channels(quantity) == 1) return {"Y"};
    if (channels(quantity) == 3) return {"R", "G", "B"};
    return {"R", "G", "B", "sign"};
}

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

} // namespace

std::vector<MapQuantity> parse_maps(const std::string& text) {
    std::vector<MapQuantity> out;
    std::string known;
    for (const MapQuantity q : all_map_quantities) known += (known.empty() ? "" : ",") + std::string(name(q));
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(',', from), text.size());
        const std::string word = text.substr(from, to - from);
        from = to + 1;
        const auto found = std::find_if(std::begin(all_map_quantities), std::end(all_map_quantities),
                                        [&](MapQuantity q) { return word == name(q); });
        if (found == std::end(all_map_quantities))
            throw usage("--maps " + text + ": '" + word + "' is no map; choose from " + known);
        if (std::find(out.begin(), out.end(), *found) != out.end())
            throw usage("--maps " + text + ": '" + word + "' twice; name each map once");
        out.push_back(*found);
    }
    return out;
}

std::string map_file(const std::string& prefix, MapQuantity quantity) { return prefix + "_" + name(quantity) + ".exr"; }

std::vector<std::unique_ptr<ImageWriter>> open_maps(const std::string& prefix,
                                                    const std::vector<MapQuantity>& quantities,
                                                    const SurfaceMapOptions& options) {
    std::vector<std::unique_ptr<ImageWriter>> writers;
    for (const MapQuantity q : quantities)
        writers.push_back(
            std::make_unique<ImageWriter>(map_file(prefix, q), options.width, options.height, channels(q),
                                          WriteOptions{.depth = Depth::float32, .channels = channel_names(q)}));
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
