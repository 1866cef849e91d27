#include "bake/relief/height/picture_kind.h"
#include "bake/base/parallel.h"
#include "bake/base/provenance.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {
namespace {

constexpr int chunk_rows = 64, lattice = 1024;

void measure_tint(const Image<float>& image, PictureKind& kind) {
    struct Tint {
        double largest = 0, sum = 0;
    };
    std::vector<Tint> chunks((image.height() + chunk_rows - 1) / chunk_rows);
    for_rows(image.height(), chunk_rows, [&](std::int64_t begin, std::int64_t end) {
        Tint& tint = chunks[begin / chunk_rows];
        for (auto y = int(begin); y < int(end); ++y) {
            const float* texel = image.row(y);
            for (int x = 0; x < image.width(); ++x, texel += image.channels()) {
                const float difference =
                    std::max({texel[0], texel[1], texel[2]}) - std::min({texel[0], texel[1], texel[2]});
                if (!(difference - difference == 0)) continue;
                tint.largest = std::max(tint.largest, 255.0 * difference);
                tint.sum += 255.0 * difference;
            }
        }
    });
    for (const Tint& tint : chunks) {
        kind.tint = std::max(kind.tint, tint.largest);
        kind.mean_tint += tint.sum / (double(image.width()) * image.height());
    }
}

bool is_constant(const Image<float>& image, int channels) {
    const float* const first = image.data();
    for (const float *v = first, *end = first + image.size(); v != end; v += image.channels())
        if (!std::equal(first, first + channels, v)) return false;
    return true;
}

// The mean of tangent-space normals is perpendicular to the surface, and they point outward. Colours rarely do both.
bool looks_like_normals(const PictureKind& kind) {
    const NormalStats& n = kind.normals;
    const bool upright = std::abs(n.mean.x) < 0.15 && std::abs(n.mean.y) < 0.15 && n.mean.z > 0.1 && n.inward < 0.1;
    if (!upright) return false;
    // Where z is rebuilt, vectors are too long only where x^2 + y^2 > 1.
    if (kind.normal_values.z < 0) return n.not_unit < 0.001;
    const bool unit = std::abs(n.length - 1) < 0.05;
    const bool perpendicular = std::abs(n.mean.x) < 0.05 && std::abs(n.mean.y) < 0.05 && n.length < 0.98;
    return unit || perpendicular;
}

} // namespace

const char* name(Looks looks) noexcept {
    switch (looks) {
    case Looks::constant: return "constant";
    case Looks::grey: return "height or mask";
    case Looks::normal_map: return "tangent normal map";
    case Looks::colour: return "colour";
    case Looks::data: break;
    }
    return "data";
}

int colour_channels(const ImageInfo& info, int channels) noexcept {
    // Alpha is the last channel in every format. A single channel is data even if it is named alpha.
    return (info.alpha_channel > 0 ? info.alpha_channel : channels) >= 3 ? 3 : 1;
}

PictureKind guess_kind(const Image<float>& image, const ImageInfo& info) {
    PictureKind kind;
    const int colours = image.channels() - (info.alpha_channel >= 0), grey = colour_channels(info, image.channels());
    if (is_constant(image, colours == 2 ? 2 : grey)) kind.looks = Looks::constant;
    if (grey == 3) measure_tint(image, kind);
    if (kind.looks == Looks::constant) return kind;
    // Slopes in 16 bits look like a normal map without blue.
    if (colours > 4 || record_word(info.record, "content") == "bump table") {
        kind.looks = Looks::data;
        return kind;
    }
    const bool tinted = grey == 3 && (kind.tint > grey_tint || kind.mean_tint > grey_mean_tint);
    if (colours == 2 || tinted) {
        kind.looks = tinted ? Looks::colour : Looks::data;
        kind.normal_values = guess_normal_values(image, info);
        kind.normals = measure_normals(image, kind.normal_values, lattice);
        // Two float channels are slopes as often as normals.
        if (looks_like_normals(kind) && !(colours == 2 && is_float(info))) {
            kind.looks = Looks::normal_map;
            kind.normals = measure_normals(image, kind.normal_values);
        }
    }
    return kind;
}

} // namespace bake
