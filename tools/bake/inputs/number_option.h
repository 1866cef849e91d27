// Options whose values are numbers and lengths. Every parse function throws Error{Refusal::usage} that names the flag.
#pragma once
#include "bake/base/vec.h"
#include "verb.h"
#include <optional>

namespace bake {

/// The whole of `text` as a finite number.
std::optional<double> parse_number(const std::string& text);

/// Adds an option for a number from `least` to `most`.
CLI::Option* add_number_option(CLI::App& sub, const std::string& flag, std::optional<double>& value, double least,
                               double most, const std::string& help);

/// "2.5" in object units, or "1%" of a length that the verb names: the diagonal of the mesh's bounding box, or the width
/// of the picture where there is no mesh.
struct Length {
    double value = 1;
    bool percent = false;
    std::string text = "1"; ///< as it was given

    double in_units(double whole) const { return percent ? value * whole : value; }
};
/// At most 1e12 in magnitude; `positive`: and above 0.
Length parse_length(const std::string& flag, const std::string& text, bool positive = true);
CLI::Option* add_length_option(CLI::App& sub, const std::string& flag, std::optional<Length>& length,
                               const std::string& help, bool positive = true);

/// "A,B", from 1e-12 to 1e12 if `positive`.
Vec2d parse_pair(const std::string& flag, const std::string& text, bool positive = true);
/// Adds --extent: the size of the picture in object units.
CLI::Option* add_extent_option(CLI::App& sub, std::optional<Vec2d>& extent, const std::string& help);

} // namespace bake
