#include "inputs/number_option.h"
#include "bake/base/parse_double.h"
#include "bake/base/text.h"
#include <cmath>

namespace bake {
namespace {

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

} // namespace

std::optional<double> parse_number(const std::string& text) { return parse_finite(text); }

std::optional<std::int64_t> parse_whole_number(const std::string& text) {
    const std::string word = text + '\n'; // ends the digits
    const char* p = word.data();
    std::int64_t value = 0;
    if (!parse_integer(p, value) || p != word.data() + text.size()) return {};
    return value;
}

double number_of(const std::string& flag, const std::string& text, double least, double most) {
    const auto value = parse_number(text);
    if (!value || *value < least || *value > most)
        throw usage(flag + " " + text + format(": is not a number from %g to %g; write such as 0.5", least, most));
    return *value;
}

int whole_number_of(const std::string& flag, const std::string& text, int least, int most) {
    const auto value = parse_whole_number(text);
    if (!value || *value < least || *value > most)
        throw usage(flag + " " + text + ": is not a whole number from " + std::to_string(least) + " to " +
                    std::to_string(most) + "; write one");
    return int(*value);
}

Length parse_length(const std::string& flag, const std::string& text, bool positive) {
    const bool percent = text.ends_with('%');
    const auto value = parse_number(percent ? text.substr(0, text.size() - 1) : text);
    if (!value || std::abs(*value) > 1e12 || (positive && !(*value > 0)))
        throw usage(flag + " " + text + ": is not a " + (positive ? "positive " : "") +
                    "number up to 1e12; write such as 0.02, or 1% of the mesh's diagonal or the picture's width");
    return {percent ? *value / 100 : *value, percent, text};
}

CLI::Option* add_length_option(CLI::App& sub, const std::string& flag, std::optional<Length>& length,
                               const std::string& help, bool positive) {
    const auto parse = [&length, flag, positive](const std::string& text) {
        length = parse_length(flag, text, positive);
    };
    return sub.add_option_function<std::string>(flag, parse, help)->type_name("LENGTH|N%");
}

Vec2d parse_pair(const std::string& flag, const std::string& text, bool positive) {
    const std::size_t comma = text.find(',');
    const auto first = parse_number(text.substr(0, comma));
    const auto second = comma == std::string::npos ? std::nullopt : parse_number(text.substr(comma + 1));
    if (!first || !second)
        throw usage(flag + " " + text + ": is not a pair; write two " + (positive ? "positive " : "") +
                    "numbers, such as 2,1");
    const auto in_range = [](double value) { return value >= 1e-12 && value <= 1e12; };
    if (positive && !(in_range(*first) && in_range(*second)))
        throw usage(flag + " " + text + ": is out of range; write two numbers from 1e-12 to 1e12, such as 2,1");
    return {*first, *second};
}

CLI::Option* add_extent_option(CLI::App& sub, std::optional<Vec2d>& extent, const std::string& help) {
    return sub
        .add_option_function<std::string>(
            "--extent", [&](const std::string& text) { extent = parse_pair("--extent", text); }, help)
        ->type_name("W,H");
}

} // namespace bake
