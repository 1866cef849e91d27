#include "options.h"
#include "bake/relief/height/dequantise.h"
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/trigonometric.hpp>

namespace bake {

CLI::Validator one_of(const std::vector<std::string>& names) { return CLI::IsMember(names).description(""); }

CLI::Validator not_empty() {
    return CLI::Validator([](std::string& text) { return std::string(text.empty() ? "is empty" : ""); }, "");
}

void add_mesh_options(CLI::App& sub, MeshOptions& options) {
    sub.add_flag("--flip-v", options.flip_v,
                 "Turn the mesh's v over: for files whose v does not run as their format says");
}

void add_height_options(CLI::App& sub, HeightArgs& args) {
    std::vector<std::pair<std::string, Filter>> filters = {{"auto", Filter::automatic}};
    for (const Filter filter : all_filters) filters.emplace_back(name(filter), filter);
    add_choice(sub, "--filter", args.filter, filters,
               "Derivative filter; auto: sobel for 256 levels or fewer, else c2");
    add_height_reading_options(sub, args);
}

void add_height_reading_options(CLI::App& sub, HeightArgs& args) {
    const std::vector<std::pair<std::string, Wrap>> wraps = {
        {"repeat", Wrap::repeat}, {"clamp", Wrap::clamp}, {"mirror", Wrap::mirror}};
    add_choice(sub, "--wrap", args.wrap, wraps, "What lies beyond the picture's border");
    // Per axis: unset until given.
    const auto per_axis = [&](const char* flag, std::optional<Wrap>& wrap, const char* help) {
        sub.add_option_function<std::string>(
               flag,
               [&wrap, wraps](const std::string& given) {
                   for (const auto& [known, value] : wraps)
                       if (known == given) wrap = value;
               },
               help)
            ->check(one_of({"repeat", "clamp", "mirror"}))
            ->type_name("repeat|clamp|mirror");
    };
    per_axis("--wrap-u", args.along_u, "The same along u alone");
    per_axis("--wrap-v", args.along_v, "The same along v alone");
    add_choice<Grey>(
        sub, "--channel", args.grey,
        {{"mean", Grey::mean}, {"r", Grey::r}, {"g", Grey::g}, {"b", Grey::b}, {"a", Grey::a}, {"luma", Grey::luma}},
        "Which grey of the picture is the height; mean: of the colour channels");
    sub.add_flag("--invert", args.invert, "Black is high");
    sub.add_flag(
        "--dequantise", args.dequantise,
        "Smooth the terraces of heights of 256 levels or fewer, within a level; for gentle heights without grain");
}

HeightTexture load_height(const HeightArgs& args) {
    HeightTexture height = read_height(args.path, args.grey);
    if (args.invert) invert(height);
    if (args.dequantise) dequantise(height, args.wrap_u(), args.wrap_v());
    return height;
}

namespace {

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

} // namespace

std::optional<double> parse_number(const std::string& text) {
    std::size_t used = 0;
    double value = 0;
    try {
        value = std::stod(text, &used);
    } catch (const std::logic_error&) {
        return {};
    }
    if (used != text.size() || !(value * 0 == 0)) return {};
    return value;
}

Amplitude parse_amplitude(const std::string& text) {
    Amplitude amplitude;
    amplitude.percent = !text.empty() && text.back() == '%';
    const auto value = parse_number(amplitude.percent ? text.substr(0, text.size() - 1) : text);
    if (!value)
        throw usage("--amplitude " + text + ": is not a number; write 0.02, or 1% of the bounding box's diagonal");
    if (std::abs(*value) > 1e12) throw usage("--amplitude " + text + ": is out of range; write at most 1e12");
    amplitude.value = amplitude.percent ? *value / 100 : *value;
    return amplitude;
}

Amplitude parse_length(const std::string& flag, const std::string& text) {
    Amplitude length;
    length.percent = !text.empty() && text.back() == '%';
    const auto value = parse_number(length.percent ? text.substr(0, text.size() - 1) : text);
    if (!value || !(*value > 0) || *value > 1e12)
        throw usage(flag + " " + text + ": is not a positive number; write 0.02, or 1% of the bounding box's diagonal");
    length.value = length.percent ? *value / 100 : *value;
    return length;
}

void check_steepness(const std::string& amplitude, double value, double length) {
    if (std::abs(value) > 1e9 * length)
        throw usage("--amplitude " + amplitude +
                    format(": is more than 1e9 times the %g it is spread over; write less", length));
}

void check_not_input(const std::string& out, const std::string& input) {
    std::error_code absent;
    if (std::filesystem::equivalent(out, input, absent))
        throw usage("--out " + out + ": would replace the picture it is made from; choose another name");
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

std::pair<int, int> parse_size(const std::string& text) {
    const std::size_t cross = text.find('x');
    const auto width = parse_number(text.substr(0, cross));
    const auto height = cross == std::string::npos ? width : parse_number(text.substr(cross + 1));
    const auto fits = [](const std::optional<double>& n) { return n && *n >= 1 && *n <= 65536 && *n == int(*n); };
    if (!fits(width) || !fits(height))
        throw usage("--size " + text + ": is not a size; write 1024 or 2048x1024, up to 65536");
    return {int(*width), int(*height)};
}

std::string describe_levels(const HeightTexture& height) {
    const std::string stored = std::string(name(height.info.type)) + " height";
    return stored + (height.levels <= 256 ? format(", %d levels", height.levels) : ", more than 256 levels");
}

double step_tilt_deg(double step, double amplitude, double extent, int texels) noexcept {
    return glm::degrees(std::atan(std::abs(amplitude) * step * texels / (2 * extent)));
}

std::string to_text(const ErrorBudget& budget) {
    return format("error budget (rms): filter %.4f, quantisation %.4f, encoding %.4f, method %.4f deg; within %.4f deg",
                  budget.filter_deg, budget.quantisation_deg, budget.encoding_deg, budget.method_deg, budget.total_deg);
}

nlohmann::json to_json(const ErrorBudget& budget) {
    return {{"filter_deg", budget.filter_deg},     {"quantisation_deg", budget.quantisation_deg},
            {"encoding_deg", budget.encoding_deg}, {"method_deg", budget.method_deg},
            {"total_deg", budget.total_deg},       {"samples", budget.samples}};
}

std::string to_text(const FilterAdvice& advice) {
    return format("--filter %s would be within %.4f deg on this height", std::string(name(advice.filter)).c_str(),
                  advice.total_deg);
}

nlohmann::json to_json(const FilterAdvice& advice) {
    return {{"filter", name(advice.filter)}, {"total_deg", advice.total_deg}};
}

namespace {
double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
} // namespace

Stopwatch::Stopwatch() : last_(now()) {}

void Stopwatch::lap(const std::string& step) {
    const double time = now();
    laps_.emplace_back(step, time - last_);
    last_ = time;
}

std::string Stopwatch::to_text() const {
    std::string line;
    for (const auto& [step, seconds] : laps_)
        line += (line.empty() ? "" : ", ") + format("%s %.3f s", step.c_str(), seconds);
    return line;
}

nlohmann::json Stopwatch::to_json() const {
    nlohmann::json object;
    for (const auto& [step, seconds] : laps_) object[step] = seconds;
    return object;
}

} // namespace bake
