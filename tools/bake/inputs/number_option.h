// Options whose values are numbers and lengths. Every parse function throws Error{Refusal::usage} that names the flag.
#pragma once
#include "bake/base/vec.h"
#include "verb.h"
#include <cstdint>
#include <optional>

namespace bake {

/// The whole of `text` as a finite decimal number. Every number of the command line is read by this function and the next.
std::optional<double> parse_number(const std::string& text);
/// The whole of `text` as a whole number: digits, and a sign before them.
std::optional<std::int64_t> parse_whole_number(const std::string& text);

/// parse_number() from `least` to `most`; the same for whole numbers.
double number_of(const std::string& flag, const std::string& text, double least, double most);
int whole_number_of(const std::string& flag, const std::string& text, int least, int most);

/// Adds an option for a number from `least` to `most`. `Value`: double, or a std::optional of it.
template <class Value>
CLI::Option* add_number_option(CLI::App& sub, const std::string& flag, Value& value, double least, double most,
                               const std::string& help) {
    const auto parse = [&value, flag, least, most](const std::string& text) {
        value = number_of(flag, text, least, most);
    };
    return sub.add_option_function<std::string>(flag, parse, help)->type_name("NUMBER");
}

/// Adds an option for a whole number from `least` to `most`, which the help shows behind `help`. `Value`: an integer, or a
/// std::optional of one.
template <class Value>
CLI::Option* add_integer_option(CLI::App& sub, const std::string& flag, Value& value, int least, int most,
                                const std::string& help) {
    const auto parse = [&value, flag, least, most](const std::string& text) {
        value = whole_number_of(flag, text, least, most);
    };
    const std::string range = " (" + std::to_string(least) + " to " + std::to_string(most) + ")";
    return sub.add_option_function<std::string>(flag, parse, help + range)->type_name("N");
}

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
