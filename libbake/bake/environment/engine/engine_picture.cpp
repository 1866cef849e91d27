#include "bake/environment/engine/engine_picture.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/environment/file/face_files.h"
#include "bake/environment/file/write_environment.h"
#include "bake/picture/rgbe_writer.h"

namespace bake {

EngineFile write_engine_picture(const Environment& sky, const EngineOptions& options, const std::string& path,
                                ResampleOptions resampling, Progress* progress) {
    const int width = options.size > 0 ? options.size : 4 * sky.face_edge();
    resampling.turn = turn_of(90 * entry_of(options.consumer).latlong->quarter_turns, 0, 0) * resampling.turn;
    EngineFile file{.path = path, .what = "panorama", .edge = width, .levels = 1};
    if (ending(path) == ".exr") {
        write_environment(sky, {.file = path, .to = SkyFormat::latlong, .size = width}, resampling, progress);
        return file;
    }
    if (width % 2 != 0)
        throw Error(Refusal::usage, "`size` " + std::to_string(width) +
                                        ": width to height of latlong is 2:1; give an "
                                        "even number");
    const Image<float> picture = to_picture(sky, Projection::latlong, width, width / 2, resampling, progress);
    BlockWriter out(path);
    write_rgbe(out, to_rgb(picture));
    file.bytes = out.bytes();
    out.commit();
    return file;
}

} // namespace bake
