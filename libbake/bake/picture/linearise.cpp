#include "bake/base/parallel.h"
#include "bake/picture/image_types.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

template <class Decode> void decode_colours(Image<float>& image, int colours, int alpha_channel, Decode&& decode) {
    const int channels = image.channels();
    for_rows(image.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            float* texel = image.row(y);
            for (int x = 0; x < image.width(); ++x, texel += channels)
                for (int c = 0; c < colours; ++c)
                    if (c != alpha_channel) texel[c] = decode(texel[c], c);
        }
    });
}

} // namespace

void srgb_to_linear(Image<float>& image, int alpha_channel) {
    decode_colours(image, image.channels(), alpha_channel,
                   [](float v, int) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); });
}

void linearise(Image<float>& image, ColourSpace space, ImageInfo& info) {
    const std::vector<ToneCurve>& curves = info.colour.curves;
    if (space == ColourSpace::automatic) {
        if (!info.colour.note.empty()) info.notes.push_back(info.colour.note);
        if (curves.empty() && info.type != SampleType::u8 && is_integer(info.type))
            info.notes.push_back("has " + std::to_string(info.bits) +
                                 "-bit integers without a colour tag: taken as linear");
    }
    const bool untagged = curves.empty() && info.type == SampleType::u8;
    if (space == ColourSpace::srgb || (space == ColourSpace::automatic && (untagged || info.colour.is_srgb())))
        return srgb_to_linear(image, info.alpha_channel);
    if (space == ColourSpace::linear || curves.empty()) return;
    if (std::all_of(curves.begin(), curves.end(), [](const ToneCurve& c) { return c.is_linear(); })) return;
    const int colours = info.colours > 0 ? std::min(info.colours, image.channels()) : image.channels();
    decode_colours(image, colours, info.alpha_channel, [&](float v, int c) {
        return float(curves[std::min<std::size_t>(std::size_t(c), curves.size() - 1)](v));
    });
}

} // namespace bake
