// Types that describe picture files.
#pragma once
#include "bake/base/provenance.h"
#include "bake/picture/colour.h"
#include <cstdint>
#include <string>
#include <vector>

namespace bake {

/// How a sample is stored in a file.
enum class SampleType { u8, u16, u32, i8, i16, i32, half, float32, other };
const char* name(SampleType type) noexcept;
/// Signed or unsigned.
bool is_integer(SampleType type) noexcept;

/// Environments as OpenEXR tags them (attribute envmap); OpenImageIO keeps the tag in TIFF too.
enum class EnvironmentTag { none, latlong, cube }; ///< cube: six square faces, one below the other

/// Description of a picture, filled from the header of its file.
struct ImageInfo {
    std::string format;                ///< "png", "openexr", "tiff", ...
    int width = 0, height = 0;         ///< full resolution
    std::vector<std::string> channels; ///< names in file order
    SampleType type = SampleType::other;
    int bits = 0;             ///< bits per sample as stored, 1 to 32
    bool srgb_tagged = false; ///< the file says its values are sRGB-encoded (see colour)
    int alpha_channel = -1;   ///< index in channels, -1 without alpha
    int colours = 0;          ///< the first channels that are grey or colour; 0: the file does not tell
    bool palette = false;     ///< the values come from a palette that is not a grey ramp
    EnvironmentTag environment = EnvironmentTag::none;
    std::string description = {}; ///< free text: PNG Description, TIFF ImageDescription, EXR comments
    std::string record = {};      ///< how the file was made, as record_text() of base/provenance.h has it
    ColourTag colour = {};        ///< how the file says its colours are encoded
    /// What the file says beside its texels that was applied to them or left out, one line each, without the file's name.
    std::vector<std::string> notes = {};
};

/// Distance of neighbouring levels of integer samples in the values that read_image gives; 0 for floats.
double level_step(const ImageInfo& info) noexcept;

struct PictureSize {
    int width = 0, height = 0, channels = 0;
};

/// Limits that a header is checked against before memory is allocated.
struct ReadLimits {
    std::int64_t max_bytes = std::int64_t(16) << 30; ///< decoded size
    std::string reason = {};                         ///< of max_bytes, as MemoryLimit has it; may be empty
};

/// How samples are stored in a written file.
enum class Depth { automatic, u8, u16, half, float32 };

/// Lossless compression. automatic: none for tif, zip for exr; png always uses deflate.
enum class Compression { automatic, none, zip };

struct WriteOptions {
    Depth depth = Depth::automatic;    ///< automatic: u16 for png, half for exr, float32 for tif
    std::vector<std::string> channels; ///< names; empty: Y, YA, RGB, RGBA by count
    Compression compression = Compression::automatic;
    EnvironmentTag environment = EnvironmentTag::none; ///< exr only: other programs then recognise an environment
    ColourSpace colour =
        ColourSpace::automatic;   ///< integer samples get the tag sRGB or linear; automatic: data, no tag
    std::string description = {}; ///< free text, as ImageInfo
    Facts facts = {};             ///< what the values mean, for the record of the file
    bool mips = false;            ///< tiles of 64 and a chain of levels, added by next_level(); exr and tif only
};

} // namespace bake
