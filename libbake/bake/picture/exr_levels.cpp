#include "bake/picture/exr_levels.h"
#include "bake/base/system_lack.h"
#include "bake/picture/exr_frame.h"
#include "bake/picture/exr_layers.h"
#include "bake/picture/image_io.h"
#include "bake/picture/picture_file.h"
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfTiledInputFile.h>

namespace bake {
namespace {

void add_smaller_levels(const std::string& path, std::vector<Image<float>>& levels) {
    Imf::TiledInputFile in(path.c_str(), exr_helpers());
    if (in.levelMode() != Imf::MIPMAP_LEVELS) return;
    std::vector<std::string> names;
    const Imf::ChannelList& channels = in.header().channels();
    for (auto c = channels.begin(); c != channels.end(); ++c) names.emplace_back(c.name());
    const LayerChoice choice = choose_layer(names);
    for (int k = 1; k < in.numLevels(); ++k) {
        const Imath::Box2i window = in.dataWindowForLevel(k);
        Image<float> level(in.levelWidth(k), in.levelHeight(k), int(choice.channels.size()));
        in.setFrameBuffer(frame_of(level.data(), choice.channels, window.min.x, window.min.y, level.width()));
        in.readTiles(0, in.numXTiles(k) - 1, 0, in.numYTiles(k) - 1, k);
        levels.push_back(std::move(level));
    }
}

} // namespace

std::vector<Image<float>> read_exr_levels(const std::string& path) try {
    std::vector<Image<float>> levels;
    ImageInfo info;
    levels.push_back(read_image(path, &info)); // checks the file
    bool tiled = false, deep = false, many = false;
    if (info.format == "openexr" && Imf::isOpenExrFile(path.c_str(), tiled, deep, many) && tiled && !deep && !many)
        add_smaller_levels(path, levels);
    return levels;
} catch (const Error&) {
    throw;
} catch (const std::exception& error) {
    if (lacks_memory(error)) throw out_of_memory(path);
    throw unreadable(path, error.what());
}

} // namespace bake
