#include "sampling_options.h"
#include "bake/preview/display.h"
#include "render_options.h"
#include <sstream>

namespace bake {
namespace {

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

std::pair<int, int> parse_pixel(const std::string& text) {
    const std::size_t comma = text.find(',');
    const auto x = parse_whole_number(text.substr(0, comma));
    const auto y = comma == std::string::npos ? std::nullopt : parse_whole_number(text.substr(comma + 1));
    if (!x || !y || *x < 0 || *y < 0 || *x > 32767 || *y > 32767)
        throw usage("--pixel " + text + ": is not a pixel; write X,Y from the upper left corner, such as 120,80");
    return {int(*x), int(*y)};
}

} // namespace

void add_sampling_options(CLI::App& sub, SamplingArgs& args) {
    add_number_option(sub, "--noise", args.noise, 1e-6, 1,
                      "Sample each tile until its standard error is below this share of its radiance, such as 0.01; "
                      "--spp is the most samples then [4096]");
    add_number_option(sub, "--time-limit", args.time_limit, 1e-3, 1e7,
                      "Render for about as many seconds, and print the samples reached; --spp is the most then. The "
                      "only option with which the picture differs from run to run");
    sub.add_flag("--halves", args.halves,
                 "With --layers: two halves of the samples, independent of each other, as half_a and half_b");
    sub.add_flag("--preview", args.preview,
                 "Write the picture again and again while it gets better, at most once a second");
    sub.add_option("--display", args.display, "Show the tiles in tev, or another viewer with its protocol [port 14158]")
        ->type_name("HOST[:PORT]");
    sub.add_option_function<std::string>(
           "--pixel", [&args](const std::string& text) { args.pixel = parse_pixel(text); },
           "Print the whole shading of a pixel instead of writing a picture")
        ->type_name("X,Y");
}

void check_sampling(const RenderArgs& args) {
    const SamplingArgs& s = args.sampling;
    if (args.out.empty() && !s.pixel) throw usage("--out is required; see bake render --help");
    if (s.halves && !args.layers) throw usage("--halves: are layers of their own; add --layers, or remove --halves");
    if (!s.display.empty()) parse_display(s.display);
    if (!s.pixel) return;
    const std::pair<const char*, bool> others[] = {
        {"--out", !args.out.empty()},     {"--layers", args.layers},
        {"--noise", s.noise.has_value()}, {"--time-limit", s.time_limit.has_value()},
        {"--preview", s.preview},         {"--display", !s.display.empty()},
        {"--crop", args.crop.has_value()}};
    for (const auto& [flag, given] : others)
        if (given) throw usage(std::string("--pixel: prints one pixel and writes no picture; remove ") + flag);
}

int most_samples(const RenderArgs& args, int scene_spp) {
    if (args.spp > 0) return args.spp;
    if (args.sampling.noise) return 4096;
    return args.sampling.time_limit ? 65536 : scene_spp;
}

PassOptions pass_options(const RenderArgs& args) {
    const SamplingArgs& s = args.sampling;
    return {
        .layers = args.layers, .halves = s.halves, .noise = s.noise.value_or(0), .seconds = s.time_limit.value_or(0)};
}

} // namespace bake
