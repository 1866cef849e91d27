// Options whose values are numbers and lengths. Every parse function throws Error{Refusal::usage} that names the flag.
#pragma once
#include "bake/base/vec.h"
#include "verb.h"
#include <optional>

namespace bake {

/// The whole of `text` as a finite number.
std::optional<double> parse_number(const std::string& text);

/// "2.5" in object units, or "1%" of the diagonal of a mesh's bounding box.
struct Amplitude {
    double value = 1;
    bool percent = false;
    std::string text = "1"; ///< as it was given

    double in_units(double diagonal) const { return percent ? value * diagonal : value; }
};
/// At most 1e12 in magnitude.
Amplitude parse_amplitude(const std::string& text);
CLI::Option* add_amplitude_option(CLI::App& sub, std::optional<Amplitude>& amplitude, const std::string& help);
/// The same for any length: positive, at most 1e12.
Amplitude parse_length(const std::string& flag, const std::string& text);
/// Refuses slopes that floats cannot hold: an amplitude above 1e9 times the length over which it rises.
void check_steepness(const std::string& amplitude, double value, double length);

/// "A,B", from 1e-12 to 1e12 if `positive`.
Vec2d parse_pair(const std::string& flag, const std::string& text, bool positive = true);
/// Adds --extent: the size of the picture in object units.
CLI::Option* add_extent_option(CLI::App& sub, std::optional<Vec2d>& extent, const std::string& help);

} // namespace bake
