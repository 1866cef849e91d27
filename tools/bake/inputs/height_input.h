// A height texture: which file, which of its channels, and how its values are read.
#pragma once
#include "bake/relief/height/height.h"
#include "bake/relief/height/slope_filter.h"
#include "verb.h"
#include <optional>

namespace bake {

struct HeightInput {
    std::string path;
    Grey grey = Grey::mean;
    Wrap wrap = Wrap::repeat;
    std::optional<Wrap> along_u, along_v;
    bool invert = false, dequantise = false;
    Filter filter = Filter::automatic;

    Wrap wrap_u() const { return along_u.value_or(wrap); }
    Wrap wrap_v() const { return along_v.value_or(wrap); }
};

/// Adds the path under this name ("--height", or "grey" for a positional one), which is required.
void add_height_path(CLI::App& sub, const std::string& name, HeightInput& input);
/// Adds an option for the grey that is taken from a picture.
CLI::Option* add_channel_option(CLI::App& sub, const std::string& flag, Grey& grey, const std::string& help);
/// Adds --wrap, --wrap-u, --wrap-v, --channel, --invert and --dequantise.
void add_height_reading_options(CLI::App& sub, HeightInput& input);
/// The same and --filter, for verbs that take slopes from texels.
void add_height_options(CLI::App& sub, HeightInput& input);
/// Reads the texture, inverted and dequantised as asked, and prints what reading it has to tell.
HeightTexture load_height(const HeightInput& input, const CommonArgs& common);
/// Prints what reading a picture has to tell.
void print_notes(const CommonArgs& common, const std::string& file, const ImageInfo& info);

/// Prints a note for every reason to doubt that the picture is a height (height_notes()). Returns the notes as printed.
std::vector<std::string> note_doubts(const CommonArgs& common, const HeightInput& input, const HeightTexture& height);

/// "uint8 height, 231 levels".
std::string describe_levels(const HeightTexture& height);
/// The tilt in degrees of one quantisation step over two texels of a surface `extent` long with `texels` along it.
double step_tilt_deg(double step, double amplitude, double extent, int texels) noexcept;

} // namespace bake
