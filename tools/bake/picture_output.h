// The picture file of bake render.
#pragma once
#include "bake/preview/passes.h"
#include "render_options.h"

namespace bake {

struct PictureOutput {
    std::string path;
    Depth depth = Depth::automatic; ///< resolved
    bool layers = false, halves = false;
    Tone tone = Tone::srgb;
    std::optional<float> exposure; ///< none: automatic, anew for each picture
};

/// Whether values are exposed and sRGB-encoded in files of this depth.
bool is_shown(Depth depth) noexcept;
/// Writes what is rendered up to now. Returns the exposure that was used.
float write_picture(const PictureOutput& output, const Passes& passes);

} // namespace bake
