// Options of bake render, and the scene that they ask for.
#pragma once
#include "bake/preview/quick_scene.h"
#include "options.h"
#include "sampling_options.h"

namespace bake {

struct RenderArgs {
    std::string input, out;
    std::optional<std::pair<int, int>> size; ///< none: the scene's
    Depth depth = Depth::automatic;
    int spp = 0; ///< 0: the scene's
    std::string on, sky, material, camera;
    MapKind as = MapKind::automatic;
    std::optional<PixelRect> crop;
    std::optional<double> yaw, exposure; ///< none: the scene's
    std::optional<TextureFilter> filter; ///< none: the scene's
    std::optional<SkyLighting> sky_light;
    bool layers = false; ///< .exr with the channels of layer_channels()
    SamplingArgs sampling;
};

void add_render_options(CLI::App& sub, RenderArgs& args);
/// Throws Error{Refusal::usage} for options that contradict each other or the kind of the input.
void check_usage(const RenderArgs& args);
/// The entries of the scene file, or of the scene made for a mesh or a map, with the options applied. `notes` receives what
/// was found or assumed.
SceneEntries read_entries(const RenderArgs& args, std::vector<std::string>& notes);
/// Keeps the pixels of --crop. Throws Error{Refusal::usage} if the crop is not in the picture.
void crop(const RenderArgs& args, RenderSettings& settings);

} // namespace bake
