#include "inputs/height_input.h"
#include "bake/base/text.h"
#include "bake/relief/height/dequantise.h"
#include "bake/relief/height/height_notes.h"
#include "bake/relief/height/repeat.h"
#include "bake/relief/height/sample_type.h"
#include "inputs/choice.h"
#include <cmath>
#include <glm/trigonometric.hpp>

namespace bake {

CLI::Option* add_height_path(CLI::App& sub, const std::string& name, HeightInput& input) {
    return sub.add_option(name, input.path, "Height picture; values are taken as they are stored, never sRGB-decoded");
}

CLI::Option* add_channel_option(CLI::App& sub, const std::string& flag, Grey& grey, const std::string& help) {
    return add_choice<Grey>(sub, flag, grey,
                            {{"mean", Grey::mean},
                             {"r", Grey::r},
                             {"g", Grey::g},
                             {"b", Grey::b},
                             {"a", Grey::a},
                             {"luma", Grey::luma}},
                            help)
        ->transform(CLI::Validator(
            [](std::string& text) {
                text = CLI::detail::to_lower(text);
                return std::string();
            },
            ""));
}

namespace {

/// "4" or "4,2"
std::pair<int, int> parse_repeat(const std::string& text) {
    constexpr long long most = 1024;
    const std::size_t comma = text.find(',');
    const auto number = [&](const std::string& part) {
        const auto value = parse_whole_number(part);
        if (!value || *value < 1 || *value > most)
            throw Error(Refusal::usage, "--repeat " + text + ": is neither N nor U,V of whole numbers from 1 to 1024");
        return int(*value);
    };
    if (comma == std::string::npos) return {number(text), number(text)};
    return {number(text.substr(0, comma)), number(text.substr(comma + 1))};
}

} // namespace

void add_height_reading_options(CLI::App& sub, HeightInput& input) {
    add_choice<Wrap>(sub, "--wrap", input.wrap,
                     {{"repeat", Wrap::repeat}, {"clamp", Wrap::clamp}, {"mirror", Wrap::mirror}},
                     "What lies beyond the picture's border");
    const auto along = [&](const char* flag, std::optional<Wrap>& wrap, const char* help) {
        add_choice<std::optional<Wrap>>(
            sub, flag, wrap, {{"repeat", Wrap::repeat}, {"clamp", Wrap::clamp}, {"mirror", Wrap::mirror}}, help);
    };
    along("--wrap-u", input.along_u, "The same along u alone");
    along("--wrap-v", input.along_v, "The same along v alone");
    add_channel_option(sub, "--channel", input.grey,
                       "Which grey of the picture is the height; mean: of the colour channels");
    sub.add_flag("--invert", input.invert, "Black is high");
    sub.add_flag(
        "--dequantise", input.dequantise,
        "Smooth the steps of heights of 256 levels or fewer by less than a level; for smooth heights without grain");
}

void add_height_options(CLI::App& sub, HeightInput& input) {
    std::vector<std::pair<std::string, Filter>> filters = {{"auto", Filter::automatic}};
    for (const Filter filter : all_filters) filters.emplace_back(name(filter), filter);
    add_choice(sub, "--filter", input.filter, filters,
               "Derivative filter; auto: sobel for 256 levels or fewer, else c2");
    add_height_reading_options(sub, input);
}

void add_relief_options(CLI::App& sub, HeightInput& input) {
    add_length_option(sub, "--amplitude", input.amplitude,
                      "Height of white above black: object units, or a per cent of the mesh's diagonal, without a mesh "
                      "of the picture's width [1%; 1 for float files, whose values are lengths]",
                      false);
    add_number_option(sub, "--midlevel", input.midlevel, -1e12, 1e12,
                      "Value that lies on the surface [0.5; 0 for float files]");
    sub.add_option_function<std::string>(
           "--repeat", [&input](const std::string& text) { input.repeat = parse_repeat(text); },
           "How often the height lies side by side along u and v [1]")
        ->type_name("N|U,V");
}

void print_notes(const CommonArgs& common, const std::string& file, const ImageInfo& info) {
    for (const std::string& line : info.notes) note(common, file + ": " + line);
}

HeightTexture load_height(const HeightInput& input, const CommonArgs& common) {
    HeightTexture height = read_height(input.path, input.grey);
    print_notes(common, input.path, height.info);
    if (input.invert) invert(height, input.midlevel);
    if (input.dequantise) dequantise(height, input.wrap_u(), input.wrap_v());
    const auto [along_u, along_v] = input.repeat;
    for (const auto& [times, wrap] : {std::pair(along_u, input.wrap_u()), std::pair(along_v, input.wrap_v())})
        if (times > 1 && wrap == Wrap::clamp)
            throw Error(Refusal::usage, "--repeat: beyond a border that is clamped nothing repeats; take --wrap repeat "
                                        "or mirror");
    repeat(height, along_u, along_v, input.wrap_u(), input.wrap_v(), input.path);
    return height;
}

std::vector<std::string> note_doubts(const CommonArgs& common, const HeightInput& input, const HeightTexture& height) {
    std::vector<std::string> notes = height_notes(height, input.wrap_u(), input.wrap_v());
    for (std::string& line : notes) {
        line = with_flags(input.path + ": " + line);
        note(common, line);
    }
    return notes;
}

HeightOptions height_options(const HeightInput& input, const ImageInfo& file, const Whole& whole) {
    return {.amplitude =
                input.amplitude ? input.amplitude->in_units(whole.length) : default_amplitude(file, whole.length),
            .midlevel = input.midlevel.value_or(default_midlevel(file)),
            .wrap_u = input.wrap_u(),
            .wrap_v = input.wrap_v()};
}

std::string default_amplitude_note(const HeightInput& input, const ImageInfo& file, const HeightOptions& used,
                                   const Whole& whole) {
    if (input.amplitude) return "";
    return format("amplitude %g, ", used.amplitude) +
           (is_float(file) ? "because the values of a float file are taken as lengths"
                           : std::string("1 % of ") + whole.name) +
           "; --amplitude sets it";
}

void check_steepness(const HeightInput& input, double amplitude, double length) {
    if (std::abs(amplitude) > 1e9 * length)
        throw Error(Refusal::usage,
                    "--amplitude " + input.amplitude.value_or(Length{}).text +
                        format(": is more than 1e9 times the %g over which it rises; write less", length));
}

std::string describe_levels(const HeightTexture& height) {
    const std::string stored = std::string(name(height.info.type)) + " height";
    return stored + (height.levels <= 256 ? format(", %d levels", height.levels) : ", more than 256 levels");
}

double step_tilt_deg(double step, double amplitude, double extent, int texels) noexcept {
    return glm::degrees(std::atan(std::abs(amplitude) * step * texels / (2 * extent)));
}

} // namespace bake
