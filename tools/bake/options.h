// Options that several verbs share, and how their values are written.
#pragma once
#include "bake/base/text.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "bake/relief/map/bump_table.h"
#include "bake/relief/map/error_budget.h"
#include "verb.h"
#include <optional>
#include <utility>
#include <vector>

namespace bake {

/// Accepts these names alone. The help does not list them a second time after the type's name.
CLI::Validator one_of(const std::vector<std::string>& names);
/// Refuses the empty text that a script's unset variable leaves.
CLI::Validator not_empty();

/// Adds an option whose value is one of a few names, and writes the value that goes with the name.
template <class Value>
CLI::Option* add_choice(CLI::App& sub, const std::string& flag, Value& value,
                        std::vector<std::pair<std::string, Value>> choices, const std::string& help) {
    std::vector<std::string> names;
    std::string joined, current;
    for (const auto& [name, choice] : choices) {
        names.push_back(name);
        joined += (joined.empty() ? "" : "|") + name;
        if (choice == value) current = name;
    }
    const auto set = [&value, choices](const std::string& name) {
        for (const auto& [known, choice] : choices)
            if (known == name) value = choice;
    };
    return sub.add_option_function<std::string>(flag, set, help)
        ->check(one_of(names))
        ->type_name(joined)
        ->default_str(current);
}

/// How a mesh is read, given the same way by every verb that reads one.
void add_mesh_options(CLI::App& sub, MeshOptions& options);

/// How a height texture is read, given the same way by every verb that reads one.
struct HeightArgs {
    std::string path;
    Grey grey = Grey::mean;
    Wrap wrap = Wrap::repeat;
    std::optional<Wrap> along_u, along_v;
    bool invert = false, dequantise = false;
    Filter filter = Filter::automatic;

    Wrap wrap_u() const { return along_u.value_or(wrap); }
    Wrap wrap_v() const { return along_v.value_or(wrap); }
};
void add_height_options(CLI::App& sub, HeightArgs& args);
/// The same without --filter, for verbs that take no slopes from texels.
void add_height_reading_options(CLI::App& sub, HeightArgs& args);
/// Reads the texture as asked, inverted and dequantised.
HeightTexture load_height(const HeightArgs& args);

/// "2.5" in object units, or "1%" of something the verb names. Throws Error{Refusal::usage} on anything else.
struct Amplitude {
    double value = 1;
    bool percent = false;
};
Amplitude parse_amplitude(const std::string& text);
/// The same for any length: positive, at most 1e12.
Amplitude parse_length(const std::string& flag, const std::string& text);
/// The whole of `text` as a finite number.
std::optional<double> parse_number(const std::string& text);
/// Throws Error{Refusal::usage} for slopes that floats cannot hold: an amplitude above 1e9 times the length it is over.
void check_steepness(const std::string& amplitude, double value, double length);
/// Throws Error{Refusal::usage} when the output would replace the input it is made from.
void check_not_input(const std::string& out, const std::string& input);

/// "W,H", from 1e-12 to 1e12 when `positive`. Throws Error{Refusal::usage}.
Vec2d parse_pair(const std::string& flag, const std::string& text, bool positive = true);
/// "N" or "WxH" texels, 1 to 65536. Throws Error{Refusal::usage}.
std::pair<int, int> parse_size(const std::string& text);

/// "8-bit height, 231 levels", and what one level means as a slope: a tilt in degrees.
std::string describe_levels(const HeightTexture& height);
/// The tilt in degrees of one quantisation step over two texels of a surface `extent` long with `texels` along it.
double step_tilt_deg(double step, double amplitude, double extent, int texels) noexcept;

std::string to_text(const ErrorBudget& budget);
nlohmann::json to_json(const ErrorBudget& budget);
std::string to_text(const FilterAdvice& advice);
nlohmann::json to_json(const FilterAdvice& advice);

/// Seconds of the steps of a run, in order.
class Stopwatch {
public:
    Stopwatch();
    /// Ends a step.
    void lap(const std::string& step);
    std::string to_text() const;
    nlohmann::json to_json() const;

private:
    double last_;
    std::vector<std::pair<std::string, double>> laps_;
};

} // namespace bake
