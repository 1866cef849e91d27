// bake check MESH --height H: what each method does wrong with the relief of a picture on meshes.
#pragma once
#include "bake/verdict/relief_check.h"
#include "options.h"

namespace bake {

/// Adds --height, and the options of the other verbs that say how it is read.
void add_height_check(CLI::App& sub, HeightInput& input);
/// Throws Error{Refusal::usage} for meshes and pictures that --height does not go with.
void check_height_usage(const HeightInput& input, const std::vector<std::string>& files);
/// `height`: loaded from the input.
ReliefReport inspect_height(const std::string& file, const HeightInput& input, const HeightTexture& height,
                            const InspectOptions& options, const CommonArgs& common);

} // namespace bake
