// What bake cubemap writes: an environment in a layout, levels of it, six files that appear together.
#pragma once
#include "bake/environment/file/environment_io.h"
#include "bake/environment/resample/resample.h"
#include "bake/picture/image_io.h"
#include <string>
#include <vector>

namespace bake {

struct CubemapTarget {
    std::string out;
    SkyFormat to = SkyFormat::automatic; ///< resolved before writing
    FaceOrder order = FaceOrder::gl;     ///< of faces and strips
    int size = 0;                        ///< edge of a face; width of a lat-long or octahedral picture
    Depth depth = Depth::automatic;
    BadPolicy bad = BadPolicy::refuse;
    bool encode_srgb = true; ///< integer samples hold sRGB
};

/// What the writing found.
struct CubemapWritten {
    std::vector<std::string> files;
    int width = 0, height = 0, levels = 0; ///< of one file
    BadTexels over;                        ///< mended because the samples cannot hold them
    std::int64_t clipped = 0;              ///< values above 1 that integer samples clip
    double seam = -1;                      ///< seam ratio of the faces written; -1: not looked at
};

bool is_cube_format(SkyFormat format) noexcept;
/// The depth of the file, 8 bits for PNG from 8-bit sources.
Depth cubemap_depth(const std::string& out, const std::string& name, SampleType source);

/// Converts and writes, face by face where the layout allows it.
CubemapWritten write_converted(const Environment& sky, const CubemapTarget& target, const ResampleOptions& options,
                               Progress* progress);
/// Writes cubes, texel-centred, level 0 first, as they are; each half as large as the one before, rounded down. More
/// than one level gives files with mips, whose chain is completed to one texel. Throws Error{Refusal::usage} for levels
/// in PNG, in crosses, and of strips whose size is no power of two.
CubemapWritten write_levels(const std::vector<Cube>& levels, const CubemapTarget& target, Progress* progress);

} // namespace bake
