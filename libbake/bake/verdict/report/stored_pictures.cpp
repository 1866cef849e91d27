#include "bake/verdict/report/stored_pictures.h"
#include "bake/base/parallel.h"
#include "bake/picture/webp.h"
#include "bake/preview/tone.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace bake {
namespace {

using Levels = Image<unsigned char>;

/// The share of the errors.
constexpr double error_share = 0.15;
/// Of errors in full size.
constexpr int least_error_quality = 80;
/// Qualities that are tried; 101 is without loss.
constexpr int qualities[] = {101, 95, 90, 86, 83, 80, 77, 74, 70, 65, 60, 50, 40, 30, 20, 10, 0};

float clean(float value) { return value > 0 ? value : 0; } // NaN too

unsigned char level(float value) { return static_cast<unsigned char>(std::lround(255 * std::clamp(value, 0.f, 1.f))); }

template <class Value> Levels levels(const Image<float>& from, const Value& value) {
    Levels to(from.width(), from.height(), 3);
    const int channels = from.channels();
    for (std::size_t i = 0; i < to.size() / 3; ++i)
        for (int c = 0; c < 3; ++c)
            to.data()[3 * i + c] = level(value(clean(from.data()[i * channels + std::min(c, channels - 1)])));
    return to;
}

Levels shown_levels(const Image<float>& light, float exposure) {
    return levels(light, [&](float v) { return shown_value(v, exposure, Tone::srgb); });
}

Levels highlight_levels(const Image<float>& light, float exposure) {
    const float scale = std::exp2(exposure);
    return levels(light, [&](float v) { return scale * v > 1 ? std::log2(scale * v) / highlight_stops : 0; });
}

Levels error_levels(const Image<float>& errors) {
    return levels(errors, [](float v) { return v; });
}

/// Half as wide and high, rounded up: means of 2 x 2 pixels.
Levels halved(const Levels& from) {
    Levels to((from.width() + 1) / 2, (from.height() + 1) / 2, 3);
    for (int y = 0; y < to.height(); ++y)
        for (int x = 0; x < to.width(); ++x) {
            const int x1 = std::min(2 * x + 1, from.width() - 1), y1 = std::min(2 * y + 1, from.height() - 1);
            for (int c = 0; c < 3; ++c) {
                const int sum =
                    from.at(2 * x, 2 * y, c) + from.at(x1, 2 * y, c) + from.at(2 * x, y1, c) + from.at(x1, y1, c);
                to.at(x, y, c) = static_cast<unsigned char>((sum + 2) / 4);
            }
        }
    return to;
}

std::vector<std::string> encode_all(const std::vector<Levels>& pictures, int quality) {
    std::vector<std::string> files(pictures.size());
    for_rows(std::int64_t(pictures.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i)
            if (!pictures[std::size_t(i)].empty())
                files[std::size_t(i)] = encode_webp(pictures[std::size_t(i)], quality);
    });
    return files;
}

double total(const std::vector<std::string>& files) {
    double bytes = 0;
    for (const std::string& file : files) bytes += double(file.size());
    return bytes;
}

/// About the size of all files, from that of the picture in the middle.
double estimate(const std::vector<Levels>& pictures, int quality) {
    const std::size_t count =
        std::size_t(std::count_if(pictures.begin(), pictures.end(), [](const Levels& p) { return !p.empty(); }));
    std::size_t seen = 0;
    for (const Levels& picture : pictures)
        if (!picture.empty() && ++seen > count / 2) return double(encode_webp(picture, quality).size() * count);
    return 0;
}

/// The files of the first quality of the list that fits into `bytes`, or of the last, and that quality.
std::vector<std::string> fit(const std::vector<Levels>& pictures, double bytes, int& quality) {
    const auto* first = std::partition_point(std::begin(qualities), std::end(qualities),
                                             [&](int q) { return estimate(pictures, q) > bytes; });
    std::vector<std::string> files;
    for (const int* q = first; q != std::end(qualities); ++q) {
        files = encode_all(pictures, quality = *q);
        if (total(files) <= bytes) break;
    }
    return files;
}

void measure_loss(const std::vector<Levels>& exact, const std::vector<std::string>& files, StoredPictures& out) {
    std::array<std::uint64_t, 256> counts{};
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const Levels decoded = decode_webp(files[i]);
        for (std::size_t k = 0; k < exact[i].size(); ++k)
            ++counts[std::size_t(std::abs(int(decoded.data()[k]) - int(exact[i].data()[k])))];
    }
    double sum = 0, squares = 0, below = 0;
    for (std::size_t d = 0; d < counts.size(); ++d)
        sum += double(counts[d]), squares += double(counts[d]) * double(d) * double(d);
    out.rms_levels = sum > 0 ? std::sqrt(squares / sum) : 0;
    for (std::size_t d = 0; d < counts.size() && below < 0.99 * sum; ++d)
        below += double(counts[d]), out.p99_levels = double(d);
}

} // namespace

double report_budget(double pixels) noexcept { return 0.188 * std::max(pixels, 11.0 * 1024 * 1024); }

StoredPictures store_pictures(const std::vector<ReportPicture>& pictures, float exposure, double budget) {
    StoredPictures out;
    out.pictures.resize(pictures.size());
    std::vector<Levels> shown(pictures.size()), highlights(pictures.size()), errors(pictures.size());
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const ReportPicture& from = pictures[i];
        if (from.picture.empty()) continue;
        shown[i] = shown_levels(from.picture, exposure);
        Levels bright = highlight_levels(from.picture, exposure);
        if (std::any_of(bright.data(), bright.data() + bright.size(), [](unsigned char v) { return v > 0; }))
            highlights[i] = std::move(bright);
        if (!from.errors.empty()) errors[i] = error_levels(from.errors);
    }
    // Errors vary more slowly than light, so that they lose less by half the size than by a low quality.
    if (estimate(errors, least_error_quality) > error_share * budget)
        for (Levels& picture : errors)
            if (!picture.empty()) picture = halved(picture), out.halved_errors = true;
    const std::vector<std::string> bright = encode_all(highlights, 101);
    const std::vector<std::string> wrong = fit(errors, error_share * budget, out.error_quality);
    // At least half is kept for what is shown, even of a sky of highlights.
    const double rest = std::max(budget - total(bright) - total(wrong), budget / 2);
    const std::vector<std::string> files = fit(shown, rest, out.quality);
    measure_loss(shown, files, out);
    for (std::size_t i = 0; i < pictures.size(); ++i) out.pictures[i] = {files[i], bright[i], wrong[i]};
    return out;
}

} // namespace bake
