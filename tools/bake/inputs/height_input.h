// A height texture: which file, which of its channels, and how its values are read.
#pragma once
#include "bake/relief/height/height.h"
#include "bake/relief/height/slope_filter.h"
#include "inputs/number_option.h"
#include <optional>

namespace bake {

struct HeightInput {
    std::string path;
    Grey grey = Grey::mean;
    Wrap wrap = Wrap::repeat;
    std::optional<Wrap> along_u, along_v;
    bool invert = false, dequantise = false;
    Filter filter = Filter::automatic;
    std::optional<Length> amplitude; ///< none: see height_options()
    std::optional<double> midlevel;
    std::pair<int, int> repeat = {1, 1}; ///< how often it lies side by side along u and v

    Wrap wrap_u() const { return along_u.value_or(wrap); }
    Wrap wrap_v() const { return along_v.value_or(wrap); }
};

/// Adds the path under this name: "--height", or "grey" for a positional one.
CLI::Option* add_height_path(CLI::App& sub, const std::string& name, HeightInput& input);
/// Adds an option for the grey that is taken from a picture.
CLI::Option* add_channel_option(CLI::App& sub, const std::string& flag, Grey& grey, const std::string& help);
/// Adds --wrap, --wrap-u, --wrap-v, --channel, --invert and --dequantise.
void add_height_reading_options(CLI::App& sub, HeightInput& input);
/// The same and --filter, for verbs that take slopes from texels.
void add_height_options(CLI::App& sub, HeightInput& input);
/// Adds --amplitude, --midlevel and --repeat.
void add_relief_options(CLI::App& sub, HeightInput& input);
/// Prints what reading a picture has to tell.
void print_notes(const CommonArgs& common, const std::string& file, const ImageInfo& info);
/// Reads the texture, inverted and dequantised as asked, and prints what reading it has to tell.
HeightTexture load_height(const HeightInput& input, const CommonArgs& common);
/// Prints a note for every reason to doubt that the picture is a height (height_notes()). Returns the notes as printed.
std::vector<std::string> note_doubts(const CommonArgs& common, const HeightInput& input, const HeightTexture& height);

/// The length that an amplitude in per cent refers to.
struct Whole {
    double length;
    const char* name; ///< "the bounding box's diagonal"
};
inline Whole diagonal_of(double length) { return {length, "the bounding box's diagonal"}; }
inline Whole width_of(double length) { return {length, "the picture's width"}; }

/// What the values of the height mean. Unless given: an integer file has an amplitude of 1 % of the whole; the values of
/// a float file are lengths, with amplitude 1; the midlevel is default_midlevel().
HeightOptions height_options(const HeightInput& input, const ImageInfo& file, const Whole& whole);
/// Which amplitude stood in for one that the user did not give; empty if the user gave it.
std::string default_amplitude_note(const HeightInput& input, const ImageInfo& file, const HeightOptions& used,
                                   const Whole& whole);
/// Refuses slopes that floats cannot hold: an amplitude above 1e9 times the length over which it rises.
void check_steepness(const HeightInput& input, double amplitude, double length);

/// "uint8 height, 231 levels".
std::string describe_levels(const HeightTexture& height);
/// The tilt in degrees of one quantisation step over two texels of a surface `extent` long with `texels` along it.
double step_tilt_deg(double step, double amplitude, double extent, int texels) noexcept;

} // namespace bake
