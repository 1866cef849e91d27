// Options of bake render that say how many samples a pixel gets, and what is shown on the way.
#pragma once
#include "bake/preview/passes.h"
#include "verb.h"

namespace bake {

struct SamplingArgs {
    std::optional<double> noise, time_limit; ///< none: every pixel gets the same number of samples
    bool halves = false, preview = false;
    std::string display;                      ///< address of a viewer; empty: none
    std::optional<std::pair<int, int>> pixel; ///< to explain, instead of writing a picture
};

struct RenderArgs;

void add_sampling_options(CLI::App& sub, SamplingArgs& args);
/// Throws Error{Refusal::usage} for options that contradict each other.
void check_sampling(const RenderArgs& args);
/// Most samples of a pixel: of --spp, or else what the other options imply, or else `scene_spp`.
int most_samples(const RenderArgs& args, int scene_spp);
PassOptions pass_options(const RenderArgs& args);

} // namespace bake
