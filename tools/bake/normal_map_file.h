// The files of the verb normal-map: the map as a picture or as a texture with all levels, and the roughness of the
// levels.
#pragma once
#include "bake/base/block_writer.h"
#include "bake/picture/image_io.h"
#include "bake/relief/map/stored_error.h"
#include "normal_map_options.h"

namespace bake {

struct StoredNormalMap {
    int mips = 0;              ///< of a texture
    int width = 0, height = 0; ///< of the largest level that is written
    bool blocks = false;       ///< bc5
    StoredError error; ///< of the largest level, read from the file; of a picture under --dither, of what it stores
    std::optional<StoredError> undithered; ///< under --dither: what rounding alone would leave
};

/// "11 mips; ..."
std::string to_text(const StoredNormalMap& stored);
nlohmann::json to_json(const StoredNormalMap& stored);

class NormalMapFile {
public:
    /// Opens the files, so that a long bake does not fail at its end. `depth` as resolve_map_depth() gives it; `relief`: the
    /// height that the map is of, if it is of one, for the record of the file.
    NormalMapFile(const NormalMapArgs& args, int width, int height, Depth depth, const HeightOptions* relief = nullptr);
    /// Writes and completes them. Says how a texture or a dithered picture was stored; nothing for another picture.
    /// `alpha`: the fourth channel of a picture under --alpha.
    std::optional<StoredNormalMap> write(const Image<float>& map, const Image<float>& alpha = {});

private:
    const NormalMapArgs& args_;
    Depth depth_;
    Facts facts_; ///< of the map
    std::optional<ImageWriter> picture_;
    std::optional<BlockWriter> texture_, roughness_;
};

} // namespace bake
