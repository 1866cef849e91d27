#include "bake/environment/file/radiance.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/text.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {
namespace {

constexpr float half_largest = 65504.0f;

bool is_bad(float value, float largest) noexcept { return !(value >= 0 && value <= largest); }

/// Alpha may have any value of either sign up to `largest`.
bool is_bad(const float* texel, int c, int alpha, float largest) noexcept {
    return is_bad(c == alpha ? std::abs(texel[c]) : texel[c], largest);
}

void count(BadTexels& bad, const float* texel, int channels, int alpha, float largest, int x, int y) noexcept {
    bool nan = false, infinite = false, negative = false, over = false;
    for (int c = 0; c < channels; ++c) {
        const float value = texel[c];
        if (!is_bad(texel, c, alpha, largest)) continue;
        if (bad.x < 0) bad.x = x, bad.y = y, bad.value = value;
        nan |= std::isnan(value);
        infinite |= std::isinf(value);
        negative |= value < 0 && !std::isinf(value) && c != alpha;
        over |= (c == alpha ? std::abs(value) : value) > largest && !std::isinf(value);
    }
    bad.nan += nan;
    bad.infinite += infinite;
    bad.negative += negative;
    bad.over += over;
    bad.texels += nan || infinite || negative || over;
}

/// NaN and infinite alpha become opaque, as the texel may be all that is there.
void mend_alpha(float& alpha, float largest) noexcept {
    alpha = std::isfinite(alpha) ? std::clamp(alpha, -largest, largest) : 1;
}

void zero_texel(float* texel, int channels, int alpha, float largest) noexcept {
    bool faulty = false;
    for (int c = 0; c < channels; ++c) faulty |= is_bad(texel, c, alpha, largest);
    if (!faulty) return;
    for (int c = 0; c < channels; ++c)
        if (c != alpha) texel[c] = 0;
        else mend_alpha(texel[c], largest);
}

void clamp_texel(float* texel, int channels, int alpha, float largest) noexcept {
    for (int c = 0; c < channels; ++c) {
        if (!is_bad(texel, c, alpha, largest)) continue;
        if (c == alpha) {
            mend_alpha(texel[c], largest);
            continue;
        }
        const float most = std::isinf(texel[c]) ? std::min(largest, half_largest) : largest;
        texel[c] = texel[c] > 0 ? most : 0; // NaN gives 0
    }
}

/// Leaves grey or colours and alpha, where the file says which these are.
void drop_extra_channels(Image<float>& image, ImageInfo& info) {
    const int alpha = info.alpha_channel, kept = info.colours + (alpha >= 0);
    if (info.colours == 0 || kept >= image.channels()) return;
    Image<float> fewer(image.width(), image.height(), kept);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            std::copy_n(&image.at(x, y), info.colours, &fewer.at(x, y));
            if (alpha >= 0) fewer.at(x, y, info.colours) = image.at(x, y, alpha);
        }
    info.notes.push_back("has " + std::to_string(image.channels() - kept) +
                         " channel(s) that are neither colour nor alpha, which are left out");
    if (alpha >= 0) info.channels[std::size_t(info.colours)] = info.channels[std::size_t(alpha)];
    info.channels.resize(std::size_t(kept));
    if (alpha >= 0) info.alpha_channel = info.colours;
    image = std::move(fewer);
}

template <class Work> void each_texel(Image<float>& image, Work&& work) {
    for_rows(image.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < image.width(); ++x) work(&image.at(x, y));
    });
}

} // namespace

BadTexels& BadTexels::operator+=(const BadTexels& later) noexcept {
    if (x < 0) x = later.x, y = later.y, value = later.value;
    nan += later.nan;
    infinite += later.infinite;
    negative += later.negative;
    over += later.over;
    texels += later.texels;
    return *this;
}

BadTexels find_bad(const Image<float>& image, float largest, int alpha) {
    std::vector<BadTexels> rows(image.height());
    const int channels = image.channels();
    for_rows(image.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const float* row = image.row(y);
            // Nearly all rows pass this quick check.
            bool any = false;
            for (int i = 0; i < image.width() * channels; ++i) any |= is_bad(row[i], largest);
            if (!any) continue;
            for (int x = 0; x < image.width(); ++x)
                count(rows[y], row + std::size_t(x) * channels, channels, alpha, largest, x, y);
        }
    });
    BadTexels all;
    for (const BadTexels& row : rows) all += row;
    return all;
}

std::string to_text(const BadTexels& bad, float largest) {
    std::string text;
    const auto add = [&](std::int64_t count, const std::string& what) {
        if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    };
    add(bad.nan, "NaN");
    add(bad.infinite, "infinite");
    add(bad.negative, "negative");
    add(bad.over, format("above %g", double(largest)));
    return text + format("; first at column %d, row %d (%g)", bad.x, bad.y, double(bad.value));
}

BadTexels mend(Image<float>& image, BadPolicy policy, const std::string& file, float largest, int alpha) {
    const BadTexels bad = find_bad(image, largest, alpha);
    if (bad.texels == 0) return bad;
    const int channels = image.channels();
    switch (policy) {
    case BadPolicy::refuse:
        throw Error(Refusal::unsuitable, file + ": holds texels that are no radiance: " + to_text(bad, largest) +
                                             "; mend the picture, or set `bad` to zero or clamp");
    case BadPolicy::zero: each_texel(image, [&](float* texel) { zero_texel(texel, channels, alpha, largest); }); break;
    case BadPolicy::clamp:
        each_texel(image, [&](float* texel) { clamp_texel(texel, channels, alpha, largest); });
        break;
    }
    return bad;
}

Image<float> read_radiance(const std::string& file, ColourSpace space, ImageInfo* info_out) {
    ImageInfo info;
    Image<float> image = read_image(file, &info);
    drop_extra_channels(image, info);
    if (image.channels() > 4)
        throw Error(Refusal::unsuitable,
                    file + ": has " + std::to_string(image.channels()) +
                        " channels; give a picture of one to four (grey, grey and alpha, RGB, RGBA)");
    linearise(image, space, info);
    if (info_out) *info_out = std::move(info);
    return image;
}

} // namespace bake
