#include "inputs/number_option.h"
#include "bake/base/text.h"
#include "inputs/choice.h"
#include <cmath>

namespace bake {
namespace {

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

std::optional<Amplitude> read_length(const std::string& text) {
    const bool percent = text.ends_with('%');
    const auto value = parse_number(percent ? text.substr(0, text.size() - 1) : text);
    if (!value || std::abs(*value) > 1e12) return {};
    return Amplitude{percent ? *value / 100 : *value, percent, text};
}

} // namespace

std::optional<double> parse_number(const std::string& text) {
    std::size_t used = 0;
    double value = 0;
    try {
        value = std::stod(text, &used);
    } catch (const std::logic_error&) {
        return {};
    }
    if (used != text.size() || !std::isfinite(value)) return {};
    return value;
}

Amplitude parse_amplitude(const std::string& text) {
    const auto amplitude = read_length(text);
    if (!amplitude)
        throw usage("--amplitude " + text +
                    ": is not a number up to 1e12; write 0.02, or 1% of the bounding box's diagonal");
    return *amplitude;
}

CLI::Option* add_amplitude_option(CLI::App& sub, std::optional<Amplitude>& amplitude, const std::string& help) {
    return sub
        .add_option_function<std::string>(
            "--amplitude", [&](const std::string& text) { amplitude = parse_amplitude(text); }, help)
        ->check(not_empty());
}

Amplitude parse_length(const std::string& flag, const std::string& text) {
    const auto length = read_length(text);
    if (!length || !(length->value > 0))
        throw usage(flag + " " + text +
                    ": is not a positive number up to 1e12; write 0.02, or 1% of the bounding box's diagonal");
    return *length;
}

void check_steepness(const std::string& amplitude, double value, double length) {
    if (std::abs(value) > 1e9 * length)
        throw usage("--amplitude " + amplitude +
                    format(": is more than 1e9 times the %g over which it rises; write less", length));
}

Vec2d parse_pair(const std::string& flag, const std::string& text, bool positive) {
    const std::size_t comma = text.find(',');
    const auto first = parse_number(text.substr(0, comma));
    const auto second = comma == std::string::npos ? std::nullopt : parse_number(text.substr(comma + 1));
    const auto in_range = [](double value) { return value >= 1e-12 && value <= 1e12; };
    if (!first || !second || (positive && !(in_range(*first) && in_range(*second))))
        throw usage(flag + " " + text + ": is not a pair; write two " + (positive ? "positive " : "") +
                    "numbers, such as 2,1");
    return {*first, *second};
}

CLI::Option* add_extent_option(CLI::App& sub, std::optional<Vec2d>& extent, const std::string& help) {
    return sub
        .add_option_function<std::string>(
            "--extent", [&](const std::string& text) { extent = parse_pair("--extent", text); }, help)
        ->check(not_empty())
        ->type_name("W,H");
}

} // namespace bake
