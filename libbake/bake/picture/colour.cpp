#include "bake/picture/colour.h"
#include "bake/base/parallel.h"
#include "bake/picture/image_types.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Whether two curves differ by less than half a level of 8 bits where a level is encoded.
bool is_close(const ToneCurve& curve, const ToneCurve& other) noexcept {
    for (int level = 0; level <= 255; ++level) {
        const double x = level / 255.0, half = 0.5 / 255;
        if (curve(x) < other(std::max(0.0, x - half)) - 1e-6 || curve(x) > other(std::min(1.0, x + half)) + 1e-6)
            return false;
    }
    return true;
}

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

double ToneCurve::operator()(double x) const noexcept {
    if (samples.empty()) return x >= d ? std::pow(std::max(0.0, a * x + b), g) + e : c * x + f;
    const double at = std::clamp(x, 0.0, 1.0) * double(samples.size() - 1);
    const auto low = std::min(std::size_t(at), samples.size() - 1), high = std::min(low + 1, samples.size() - 1);
    return samples[low] + (at - double(low)) * (double(samples[high]) - samples[low]);
}

ToneCurve power_curve(double exponent) { return {.g = exponent}; }

ToneCurve srgb_curve() { return {.g = 2.4, .a = 1 / 1.055, .b = 0.055 / 1.055, .c = 1 / 12.92, .d = 0.04045}; }

bool ToneCurve::is_srgb() const noexcept { return is_close(*this, srgb_curve()); }
bool ToneCurve::is_linear() const noexcept { return is_close(*this, ToneCurve{}); }

bool ColourTag::is_srgb() const noexcept {
    return !curves.empty() && std::all_of(curves.begin(), curves.end(), [](const ToneCurve& c) { return c.is_srgb(); });
}

void srgb_to_linear(Image<float>& image, int alpha_channel) {
    decode_colours(image, image.channels(), alpha_channel,
                   [](float v, int) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); });
}

float linear_to_srgb(float linear) noexcept {
    if (!(linear > 0)) return 0;
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
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
