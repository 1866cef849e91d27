// Writing environments in any format: six files or one, with or without mip levels.
#pragma once
#include "bake/environment/file/radiance.h"
#include "bake/environment/resample/resample.h"
#include "bake/environment/sky/sky_format.h"
#include <string>
#include <vector>

namespace bake {

struct EnvironmentTarget {
    std::string file;                    ///< with a %s: a pattern for six files
    SkyFormat to = SkyFormat::automatic; ///< automatic: format_of_name
    FaceOrder order = FaceOrder::gl;     ///< of the files of faces and of strips
    int size = 0; ///< edge of a face, or width of a picture of the whole sky; 0: as fine as the source
    /// automatic: by the file's ending; 8 bits for a PNG from an 8-bit source; float for an EXR with radiance that half
    /// floats cannot hold.
    Depth depth = Depth::automatic;
    SampleType source = SampleType::other; ///< of the files that the environment was read from
    BadPolicy bad = BadPolicy::refuse;     ///< for values that half floats cannot hold, when `depth` is half
    bool encode_srgb = true;               ///< integer samples hold sRGB
};

/// Findings of the writer.
struct EnvironmentWritten {
    EnvironmentTarget target; ///< as completed by complete_target
    std::vector<std::string> files;
    int width = 0, height = 0, levels = 0; ///< of one file
    BadTexels over;                        ///< too large for the samples, and mended
    std::int64_t clipped = 0;              ///< values above 1 that integer samples clip
};

/// faces for a name with a %s, openexr_cube for the ending .exr, in any case, otherwise strip.
SkyFormat format_of_name(const std::string& file);

/// Replaces the automatic values of a target for a source whose equally fine cube has faces of `edge` texels. Throws
/// Error{Refusal::usage} for a size, depth or file name that the format cannot have.
EnvironmentTarget complete_target(EnvironmentTarget target, int edge);

/// Refuses what write_levels() would refuse, before the levels are computed: more than one level in a format without mips,
/// or in one picture of faces whose edge is not a power of two. `edge`: of level 0; 0 where it is not known yet. Throws
/// Error{Refusal::usage}.
void check_levels(const EnvironmentTarget& target, std::size_t levels, int edge);

/// Converts an environment and writes it. Six files and strips are made and written in bands of rows. Files appear under
/// their names all together or not at all.
EnvironmentWritten write_environment(const Environment& sky, const EnvironmentTarget& target,
                                     const ResampleOptions& options = {}, Progress* progress = nullptr);

/// Writes texel-centred cubes, level 0 first, each half as large as the one before, rounded down. More than one level gives
/// files with mip levels; the chain is completed to one texel by next_mip. Throws as check_levels().
EnvironmentWritten write_levels(std::vector<Cube> levels, const EnvironmentTarget& target,
                                Progress* progress = nullptr);

} // namespace bake
