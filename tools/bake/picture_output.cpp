#include "picture_output.h"
#include "bake/picture/image_io.h"
#include <algorithm>

namespace bake {
namespace {

/// Values as the file stores them: exposed and sRGB-encoded for integer samples, else clamped to the range of the type.
void encode(Image<float>& image, Depth depth, Tone tone, float exposure) {
    const float largest = depth == Depth::half ? 65504.0f : 3e38f;
    for (std::size_t i = 0; i < image.size(); ++i) {
        float& value = image.data()[i];
        value = is_shown(depth) ? shown_value(value, exposure, tone) : std::clamp(value, -largest, largest);
    }
}

} // namespace

bool is_shown(Depth depth) noexcept { return depth == Depth::u8 || depth == Depth::u16; }

float write_picture(const PictureOutput& output, const Passes& passes) {
    Image<float> image = output.layers ? passes.layers() : passes.picture();
    const float exposure = output.exposure ? *output.exposure : automatic_exposure(image);
    encode(image, output.depth, output.tone, exposure);
    WriteOptions options{.depth = output.depth,
                         .colour = is_shown(output.depth) ? ColourSpace::srgb : ColourSpace::automatic};
    options.facts = {{"content", std::string("picture")},
                     {"encoding", std::string(is_shown(output.depth) ? "as shown" : "linear radiance")}};
    if (is_shown(output.depth)) options.facts.push_back({"exposure", double(exposure)});
    if (output.layers) options.channels = layer_channels(output.halves);
    write_image(output.path, image, options);
    return exposure;
}

} // namespace bake
