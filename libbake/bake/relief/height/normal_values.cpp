#include "bake/relief/height/normal_values.h"
#include "bake/base/parallel.h"
#include "bake/picture/image_io.h"
#include "bake/relief/height/sample_type.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {
namespace {

constexpr int chunk_rows = 64, guess_lattice = 256;

float finite_or_zero(float v) noexcept { return v - v == 0 ? v : 0; }

float to_linear(float v) noexcept { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

NormalStats sum_rows(const Image<float>& image, const NormalValues& values, int step_x, int begin, int end,
                     int step_y) {
    NormalStats s;
    for (int y = begin; y < end; ++y)
        for (int x = step_x / 2; x < image.width(); x += step_x) {
            const Vec3f t = values.decode(&image.at(x, y * step_y + step_y / 2));
            const Vec3d n(finite_or_zero(t.x), finite_or_zero(t.y), finite_or_zero(t.z));
            const double length = glm::length(n);
            s.length += length;
            s.length_error += std::abs(length - 1);
            s.not_unit += std::abs(length - 1) > 0.02;
            s.inward += n.z < 0;
            s.mean += n;
        }
    return s;
}

/// 0 for unit vectors whose mean is the z axis.
double misfit(const Image<float>& image, const NormalValues& values) {
    const NormalStats s = measure_normals(image, values, guess_lattice);
    // A map may lean as a whole, so that its mean weighs less than its lengths.
    return s.length_error + 0.6 * glm::length(Vec2d(s.mean)) + s.inward;
}

bool is_constant(const Image<float>& image, int channel) {
    const float first = image.at(0, 0, channel);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (image.at(x, y, channel) != first) return false;
    return true;
}

NormalValues guess_channels(const Image<float>& image, const ImageInfo& info) {
    if (image.channels() == 2 || info.alpha_channel == 2) return {.z = -1};
    const bool red = is_constant(image, 0), green = is_constant(image, 1), blue = is_constant(image, 2);
    const int alpha = info.alpha_channel;
    if (alpha >= 3 && red && !green && !is_constant(image, alpha)) return {.x = alpha, .z = -1};
    return {.z = blue && !(red && green) ? -1 : 2};
}

} // namespace

Vec3f NormalValues::decode(const float* texel) const noexcept {
    const auto one = [this](float v) {
        switch (encoding) {
        case NormalEncoding::signed_: return v;
        case NormalEncoding::srgb_encoded: return 2 * to_linear(v) - 1;
        case NormalEncoding::srgb_decoded: return 2 * linear_to_srgb(v) - 1;
        default: return 2 * v - 1;
        }
    };
    const float n_x = one(texel[x]), n_y = one(texel[y]);
    return {n_x, n_y, z < 0 ? std::sqrt(std::max(0.0f, 1 - n_x * n_x - n_y * n_y)) : one(texel[z])};
}

Image<float> decode_normals(const Image<float>& image, const NormalValues& values) {
    Image<float> vectors(image.width(), image.height(), 3);
    for_rows(image.height(), chunk_rows, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const float* texel = image.row(y);
            float* out = vectors.row(y);
            for (int x = 0; x < image.width(); ++x, texel += image.channels(), out += 3) {
                const Vec3f n = values.decode(texel);
                out[0] = n.x, out[1] = n.y, out[2] = n.z;
            }
        }
    });
    return vectors;
}

NormalStats measure_normals(const Image<float>& image, const NormalValues& values, int lattice) {
    const auto step = [lattice](int size) { return lattice > 0 ? std::max(1, size / lattice) : 1; };
    const int step_x = step(image.width()), step_y = step(image.height()), rows = image.height() / step_y;
    std::vector<NormalStats> chunks((rows + chunk_rows - 1) / chunk_rows);
    for_rows(rows, chunk_rows, [&](std::int64_t begin, std::int64_t end) {
        chunks[begin / chunk_rows] = sum_rows(image, values, step_x, int(begin), int(end), step_y);
    });
    NormalStats all;
    for (const NormalStats& s : chunks) {
        all.length += s.length, all.length_error += s.length_error, all.not_unit += s.not_unit;
        all.inward += s.inward, all.mean += s.mean;
    }
    const int columns = (image.width() - step_x / 2 + step_x - 1) / step_x;
    const double texels = double(columns) * rows;
    all.length /= texels, all.length_error /= texels, all.not_unit /= texels;
    all.inward /= texels, all.mean /= texels;
    return all;
}

NormalValues guess_normal_values(const Image<float>& image, const ImageInfo& info) {
    NormalValues values = guess_channels(image, info);
    if (is_signed_integer(info)) {
        values.encoding = NormalEncoding::signed_;
        return values;
    }
    double least = misfit(image, values);
    const auto take_if_below = [&](NormalEncoding encoding, double limit) {
        NormalValues other = values;
        other.encoding = encoding;
        const double found = misfit(image, other);
        if (found < limit) values = other, least = found;
    };
    if (is_float(info)) take_if_below(NormalEncoding::signed_, least);
    // Maps whose vectors are short, or that lean, are common; those that another transfer curve makes unit and upright
    // are not.
    if (least > 0.25)
        for (const NormalEncoding curve : {NormalEncoding::srgb_encoded, NormalEncoding::srgb_decoded})
            take_if_below(curve, std::min(0.1, least));
    return values;
}

std::string describe(const NormalValues& values) {
    std::string text;
    if (values.z < 0)
        text = values.x > 1 ? "x in alpha, y in green: z is rebuilt from x and y"
                            : "two channels: z is rebuilt from x and y";
    const char* const encoding = values.encoding == NormalEncoding::signed_ ? "signed values: n = rgb"
                                 : values.encoding == NormalEncoding::srgb_encoded
                                     ? "the normals are sRGB-encoded: unit length after decoding them"
                                 : values.encoding == NormalEncoding::srgb_decoded
                                     ? "the normals are sRGB-decoded: unit length after encoding them"
                                     : "";
    return text + (text.empty() || !*encoding ? "" : "; ") + encoding;
}

} // namespace bake
