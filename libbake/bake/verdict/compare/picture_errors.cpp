#include "bake/verdict/compare/picture_errors.h"
#include "bake/base/parallel.h"
#include "bake/picture/colour.h"
#include "bake/verdict/compare/picture_pair.h"
#include "bake/verdict/metric/ssim.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace bake {
namespace {

constexpr int tile_edge = 32;

using Pixels = std::vector<std::uint8_t>;

/// Linear light as a screen would show it: exposed and clamped to [0, 1].
Image<float> exposed(const Image<float>& light, float exposure) {
    Image<float> out(light.width(), light.height(), light.channels());
    const float factor = std::exp2(exposure);
    for (std::size_t i = 0; i < light.size(); ++i) out.data()[i] = std::clamp(light.data()[i] * factor, 0.0f, 1.0f);
    return out;
}

Halves exposed(const Halves& halves, float exposure) {
    return {exposed(halves.a, exposure), exposed(halves.b, exposure)};
}

Halves shown(const Halves& halves, float exposure) { return {shown(halves.a, exposure), shown(halves.b, exposure)}; }

/// Of pictures of three channels. See the head of the header.
Estimate square_of(const Halves& x, const Halves& y, const Pixels& pixels) {
    double sum = 0, variance = 0, count = 0;
    for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel) {
        if (!pixels[pixel]) continue;
        double product = 0, first = 0, second = 0;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            const double a = double(y.a.data()[i]) - x.a.data()[i], b = double(y.b.data()[i]) - x.b.data()[i];
            product += a * b, first += a * a, second += b * b;
        }
        sum += product / 3;
        variance += (first - second) * (first - second) / 36;
        ++count;
    }
    if (count == 0) return {};
    return {sum / count, std::sqrt(variance) / count};
}

Estimate psnr_of(const Estimate& square) noexcept {
    if (square.value <= 0) return {std::numeric_limits<double>::infinity(), 0};
    return {-10 * std::log10(square.value), 10 / std::log(10.0) * square.error / square.value};
}

/// Errors of the pixels of the whole samples and of their halves; (x, y) of the errors is pixel (x + border, y + border).
struct ErrorMaps {
    Image<float> whole, a, b;
    int border = 0;
};

struct Averaged {
    Estimate mean;
    std::vector<double> values;
};

Averaged average(const ErrorMaps& maps, const Pixels& pixels, int width) {
    const int columns = (maps.whole.width() + tile_edge - 1) / tile_edge;
    const int rows = (maps.whole.height() + tile_edge - 1) / tile_edge;
    std::vector<double> difference(std::size_t(columns) * std::size_t(rows));
    Averaged result;
    double sum = 0, squares = 0;
    for (int y = 0; y < maps.whole.height(); ++y)
        for (int x = 0; x < maps.whole.width(); ++x) {
            if (!pixels[std::size_t(y + maps.border) * std::size_t(width) + std::size_t(x + maps.border)]) continue;
            const double value = double(maps.whole.at(x, y));
            sum += value;
            result.values.push_back(value);
            difference[std::size_t(y / tile_edge) * std::size_t(columns) + std::size_t(x / tile_edge)] +=
                (double(maps.a.at(x, y)) - double(maps.b.at(x, y))) / 2;
        }
    if (result.values.empty()) return result;
    for (const double d : difference) squares += d * d;
    const double count = double(result.values.size());
    result.mean = {sum / count, std::sqrt(squares) / count};
    return result;
}

/// Everything that is averaged over pixels.
struct AllMaps {
    Halves light_x, light_y, shown_x, shown_y;
    ErrorMaps flip, hdr_flip, ssim;
};

AllMaps make_maps(const Halves& reference, const Halves& test, const PictureErrorOptions& options) {
    AllMaps maps{exposed(reference, options.exposure),
                 exposed(test, options.exposure),
                 shown(reference, options.exposure),
                 shown(test, options.exposure),
                 {},
                 {},
                 {}};
    const Image<float> x = mean_picture(reference), y = mean_picture(test);
    maps.flip = {flip(exposed(x, options.exposure), exposed(y, options.exposure), options.flip),
                 flip(maps.light_x.a, maps.light_y.a, options.flip),
                 flip(maps.light_x.b, maps.light_y.b, options.flip)};
    const ExposureRange range = exposure_range(x);
    maps.hdr_flip = {hdr_flip(x, y, range, options.flip), hdr_flip(reference.a, test.a, range, options.flip),
                     hdr_flip(reference.b, test.b, range, options.flip)};
    if (std::min(x.width(), x.height()) < ssim_window) return maps;
    const auto errors = [](const Image<float>& a, const Image<float>& b) { return ssim(luma(a), luma(b)).errors; };
    maps.ssim = {errors(shown(x, options.exposure), shown(y, options.exposure)), errors(maps.shown_x.a, maps.shown_y.a),
                 errors(maps.shown_x.b, maps.shown_y.b), ssim_window / 2};
    return maps;
}

AreaErrors area_errors(const AllMaps& maps, const Pixels& pixels, int width) {
    AreaErrors errors;
    errors.pixels = std::count(pixels.begin(), pixels.end(), 1);
    errors.square = square_of(maps.light_x, maps.light_y, pixels);
    errors.rmse = root(errors.square);
    errors.psnr = psnr_of(square_of(maps.shown_x, maps.shown_y, pixels));
    Averaged flip = average(maps.flip, pixels, width), hdr = average(maps.hdr_flip, pixels, width);
    errors.flip = flip.mean, errors.hdr_flip = hdr.mean;
    errors.flip_of_pixels = summarise(std::move(flip.values));
    errors.hdr_flip_of_pixels = summarise(std::move(hdr.values));
    const Estimate lost = maps.ssim.whole.empty() ? Estimate{} : average(maps.ssim, pixels, width).mean;
    errors.ssim = {1 - lost.value, lost.error};
    return errors;
}

Vec3d normal_at(const Image<float>& normals, std::size_t pixel) noexcept {
    const float* n = normals.data() + 3 * pixel;
    return {n[0], n[1], n[2]};
}

/// Pixels of which all rays hit the object in both pictures.
ErrorSummary angles_between(const MethodPicture& x, const MethodPicture& y) {
    const int factor = x.mask.factor, width = x.mask.width / factor;
    std::vector<int> covered(x.normals.size() / 3);
    for (int row = 0; row < x.mask.height; ++row)
        for (int column = 0; column < x.mask.width; ++column)
            covered[std::size_t(row / factor) * std::size_t(width) + std::size_t(column / factor)] +=
                x.mask.at(column, row) && y.mask.at(column, row);
    std::vector<double> angles;
    for (std::size_t pixel = 0; pixel < covered.size(); ++pixel) {
        const Vec3d a = normal_at(x.normals, pixel), b = normal_at(y.normals, pixel);
        if (covered[pixel] < factor * factor || a == Vec3d(0) || b == Vec3d(0)) continue;
        angles.push_back(180 / pi * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
    }
    return summarise(std::move(angles));
}

/// A square of an eighth of the picture's width, moved in steps of half its edge.
PixelRect worst_part(const Image<float>& errors) {
    const int edge =
        std::max(1, std::min({std::max(errors.width(), errors.height()) / 8, errors.width(), errors.height()}));
    const int step = std::max(1, edge / 2);
    PixelRect worst{0, 0, edge, edge};
    double most = -1;
    for (int y = 0; y + edge <= errors.height(); y += step)
        for (int x = 0; x + edge <= errors.width(); x += step) {
            double sum = 0;
            for (int row = y; row < y + edge; ++row)
                for (int column = x; column < x + edge; ++column) sum += double(errors.at(column, row));
            if (sum > most) most = sum, worst.x = x, worst.y = y;
        }
    return worst;
}

} // namespace

Image<float> mean_picture(const Halves& halves) {
    Image<float> mean(halves.a.width(), halves.a.height(), halves.a.channels());
    for (std::size_t i = 0; i < mean.size(); ++i)
        mean.data()[i] = 0.5f * halves.a.data()[i] + 0.5f * halves.b.data()[i];
    return mean;
}

Estimate root(const Estimate& square) noexcept {
    const double value = std::sqrt(std::max(0.0, square.value));
    // The derivative of the root, and where the square is within its noise the root of the noise.
    const double error = square.value > square.error ? square.error / (2 * value) : std::sqrt(square.error);
    return {value, error};
}

Estimate square_error(const Halves& reference, const Halves& test, float exposure, const Pixels& pixels) {
    return square_of(exposed(reference, exposure), exposed(test, exposure), pixels);
}

PictureErrors picture_errors(const MethodPicture& reference, const MethodPicture& test,
                             const PictureErrorOptions& options) {
    AllMaps maps = make_maps(reference.halves, test.halves, options);
    const int width = reference.halves.a.width();
    const Pixels object = pixels_of_either(reference.mask, test.mask);
    PictureErrors errors;
    errors.object = area_errors(maps, object, width);
    errors.frame = area_errors(maps, Pixels(object.size(), 1), width);
    errors.angles = angles_between(reference, test);
    errors.outline = outline_error(reference.mask, test.mask);
    errors.flip = std::move(maps.flip.whole);
    errors.worst = worst_part(errors.flip);
    return errors;
}

FrameErrors frame_errors(const Halves& reference, const Halves& test, const PictureErrorOptions& options) {
    const Pixels all(reference.a.size() / 3, 1);
    FrameErrors errors;
    errors.rmse = root(square_error(reference, test, options.exposure, all));
    errors.flip = flip(exposed(mean_picture(reference), options.exposure),
                       exposed(mean_picture(test), options.exposure), options.flip);
    errors.flip_summary = summarise(errors.flip);
    errors.worst = worst_part(errors.flip);
    return errors;
}

} // namespace bake
