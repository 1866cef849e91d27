// What the tests of bake displace share: inputs, and the command itself.
#pragma once
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cmath>
#include <string>
#include <vector>

namespace bake::test {

inline const std::string torus = (own_meshes() / "torus.obj").string();

/// A cube whose faces have a chart each, with the height's whole unit square.
inline const std::string cube_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 4/2 3/3 2/4\nf 5/1 6/2 7/3 8/4\nf 1/1 2/2 6/3 5/4\nf 2/1 3/2 7/3 6/4\nf 3/1 4/2 "
    "8/3 7/4\nf 4/1 1/2 5/3 8/4\n";

/// The picture whose texel (x, y) has the channels value(x, y, c).
template <class Value>
void write_picture(const std::string& file, int width, int height, int channels, const Value& value,
                   Depth depth = Depth::float32) {
    Image<float> image(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) image.at(x, y, c) = float(value(x, y, c));
    write_image(file, image, {.depth = depth});
}

/// Waves that tile, in 16 bits. Plain TIFF: nothing else is read as quickly.
inline std::string waves(const Folder& folder) {
    if (!fs::exists(folder / "waves.tif"))
        write_picture(
            folder / "waves.tif", 64, 64, 1,
            [](int x, int y, int) {
                return 0.5 + 0.3 * std::sin(x * 0.1963495408) + 0.2 * std::cos(y * 0.2945243113 + 1);
            },
            Depth::u16);
    return "waves.tif";
}

inline Run displaced(const Folder& folder, std::vector<std::string> arguments, const RunLimits& limits = {}) {
    arguments.insert(arguments.begin(), "displace");
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    CAPTURE(line);
    const Run run = run_bake(folder, arguments, limits);
    CAPTURE(run.err);
    CHECK(run.code == 0);
    return run;
}

} // namespace bake::test
