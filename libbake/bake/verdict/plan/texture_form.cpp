#include "bake/verdict/plan/texture_form.h"
#include "bake/base/parallel.h"
#include "bake/base/text.h"
#include "bake/picture/bc5.h"
#include "bake/picture/colour.h"
#include "bake/preview/loaded_picture.h"
#include "bake/relief/map/bake_budget.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

struct Storage {
    int channels, bits;
    bool half;
};

std::vector<Storage> storages(TextureUse use, bool grey) {
    switch (use) {
    case TextureUse::normal:
        return {{2, bc5_bits, false}, {2, 8, false}, {3, 8, false}, {2, 16, false}, {3, 16, false}};
    case TextureUse::bump: return {{2, 16, false}, {2, 16, true}};
    case TextureUse::albedo: break;
    }
    const int channels = grey ? 1 : 3;
    return {{channels, 8, false}, {channels, 16, false}, {channels, 16, true}};
}

Depth depth_of(const TextureForm& form) noexcept {
    if (form.bits == 32) return Depth::float32;
    return form.half ? Depth::half : form.bits == 8 ? Depth::u8 : Depth::u16;
}

/// The texel of an integer or float form.
Vec3f stored_unit(const Vec3f& unit, const TextureForm& form) {
    const Depth depth = depth_of(form);
    if (depth == Depth::float32) return unit;
    Vec3f read = decode_normal(stored_normal(encode_normal(unit, false), depth), false);
    if (form.channels == 2) read.z = std::sqrt(std::max(0.0f, 1 - read.x * read.x - read.y * read.y));
    return read;
}

void store_normals(Image<float>& image, const TextureForm& form) {
    for_rows(image.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < image.width(); ++x) {
                float* t = &image.at(x, y);
                Vec3f unit(t[0], t[1], t[2]);
                // A source that is kept whole stays as it is.
                if (form.halvings > 0 || form.channels == 2) unit = unit_or_zero(unit);
                const Vec3f read = form.in_bc5() ? unit : stored_unit(unit, form);
                for (int c = 0; c < 3; ++c) t[c] = read[c];
            }
    });
    if (form.in_bc5()) bc5_round(image);
}

void store_slopes(Image<float>& image, const TextureForm& form) {
    if (form.bits == 32) return;
    float range = 0;
    for (std::size_t i = 0; i < image.size(); ++i) range = std::max(range, std::abs(image.data()[i]));
    const SlopeCode code{range > 0 ? range : 1};
    for (std::size_t i = 0; i < image.size(); ++i) {
        float& slope = image.data()[i];
        slope = form.half ? as_half(slope) : code.decode(code.encode(slope));
    }
}

void store_colours(Image<float>& image, const TextureForm& form) {
    if (form.bits == 32) return;
    const float largest = form.bits == 8 ? 255 : 65535;
    for (std::size_t i = 0; i < image.size(); ++i) {
        float& value = image.data()[i];
        value = form.half ? as_half(std::min(value, 65504.0f))
                          : std::round(std::clamp(linear_to_srgb(value), 0.0f, 1.0f) * largest) / largest;
    }
    if (!form.half) srgb_to_linear(image);
}

} // namespace

std::int64_t TextureForm::bytes() const noexcept {
    std::int64_t sum = 0;
    for (int w = width, h = height;; w = std::max(1, w / 2), h = std::max(1, h / 2)) {
        sum += in_bc5() ? std::int64_t(bc5_bytes(w, h)) : std::int64_t(w) * h * channels * bits / 8;
        if (w == 1 && h == 1) return sum;
    }
}

std::string TextureForm::text() const {
    if (in_bc5()) return format("%d x %d, BC5", width, height);
    constexpr const char* counts[] = {"no channel", "one channel", "two channels", "three channels", "four channels"};
    const char* kind = half ? "half floats" : bits == 32 ? "floats" : bits == 8 ? "8 bits" : "16 bits";
    return format("%d x %d, %s of %s", width, height, counts[std::clamp(channels, 0, 4)], kind);
}

std::vector<TextureForm> texture_forms(TextureUse use, int width, int height, bool grey) {
    std::vector<TextureForm> forms;
    for (int halvings = 0;; ++halvings) {
        for (const Storage& storage : storages(use, grey))
            forms.push_back({halvings, width, height, storage.channels, storage.bits, storage.half});
        if (width == 1 && height == 1) break;
        width = std::max(1, width / 2), height = std::max(1, height / 2);
    }
    std::stable_sort(forms.begin(), forms.end(),
                     [](const TextureForm& a, const TextureForm& b) { return a.bytes() < b.bytes(); });
    return forms;
}

std::vector<Image<float>> halvings_of(const Image<float>& source) {
    std::vector<Image<float>> levels;
    levels.push_back(copied(source));
    while (levels.back().width() > 1 || levels.back().height() > 1) levels.push_back(halve(levels.back()));
    return levels;
}

Image<float> stored(const Image<float>& halving, TextureUse use, const TextureForm& form) {
    Image<float> image = copied(halving);
    switch (use) {
    case TextureUse::normal: store_normals(image, form); break;
    case TextureUse::bump: store_slopes(image, form); break;
    case TextureUse::albedo: store_colours(image, form); break;
    }
    return image;
}

bool is_grey(const Image<float>& image) noexcept {
    if (image.channels() < 3) return true;
    const auto channels = std::size_t(image.channels());
    for (std::size_t i = 0; i < image.size(); i += channels)
        if (image.data()[i] != image.data()[i + 1] || image.data()[i] != image.data()[i + 2]) return false;
    return true;
}

TextureForm lossless_form(const Image<float>& source, TextureUse use, bool blocks) {
    const bool grey = use == TextureUse::albedo && is_grey(source);
    // What is read from integers is computed in float.
    constexpr float rounding = 1e-6f;
    for (const TextureForm& form : texture_forms(use, source.width(), source.height(), grey)) {
        if (form.halvings > 0 || (form.in_bc5() && !blocks)) continue;
        const Image<float> read = stored(source, use, form);
        const auto same = [&](float a, float b) { return std::abs(a - b) <= rounding * std::max(1.0f, std::abs(a)); };
        if (std::equal(read.data(), read.data() + read.size(), source.data(), same)) return form;
    }
    return {0, source.width(), source.height(), use == TextureUse::bump ? 2 : grey ? 1 : 3, 32, true};
}

} // namespace bake
