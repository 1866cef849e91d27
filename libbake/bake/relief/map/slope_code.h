// Signed slopes in the unsigned levels of a 16-bit picture.
//
//   level = round(slope / range * 32767) + 32768
//
// The level 32768 means slope 0. The range is stored in the file: bump-table writes to_text(code) as the picture's
// description, and slope_code() reads it from there.
#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace bake {

struct SlopeCode {
    float range = 1; ///< slope of the largest level; positive

    /// level / 65535 before the level is rounded, as ImageWriter takes it.
    float encode(float slope) const noexcept { return (slope / range * 32767 + 32768) / 65535; }
    /// Slope of level / 65535, as read_image returns it.
    float decode(float value) const noexcept { return (std::round(value * 65535) - 32768) / 32767 * range; }
};

/// "slope = (level - 32768) / 32767 * RANGE"
std::string to_text(const SlopeCode& code);

/// The code in a picture's description (ImageInfo::description); nothing if the description has none.
std::optional<SlopeCode> slope_code(std::string_view description);

} // namespace bake
