#include "bake/environment/file/mend_sky.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/text.h"
#include "bake/environment/sky/solid_angle.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {
namespace {

/// Relative solid angle of texel (x, y) of a picture of the whole sky; 0 outside a disc.
double picture_weight(Projection projection, int w, int h, int x, int y) noexcept {
    if (is_latlong(projection)) return std::sin((y + 0.5) / h * pi);
    const Vec3d here = picture_direction(projection, w, h, x, y);
    return glm::length(glm::cross(picture_direction(projection, w, h, x + 1, y) - here,
                                  picture_direction(projection, w, h, x, y + 1) - here));
}

struct Fluxes {
    double positive = 0, negative = 0;
};

/// Sums of the finite values, weighted by solid angle; `weight(x, y)`.
template <class Weight> Fluxes fluxes_of(const Image<float>& image, int alpha, Weight&& weight) {
    std::vector<Fluxes> rows(image.height());
    for_rows(image.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < image.width(); ++x) {
                const double omega = weight(x, y);
                for (int c = 0; c < image.channels(); ++c) {
                    const double value = image.at(x, y, c);
                    if (c == alpha || !std::isfinite(value)) continue;
                    (value < 0 ? rows[y].negative : rows[y].positive) += omega * std::abs(value);
                }
            }
    });
    Fluxes all;
    for (const Fluxes& row : rows) all.positive += row.positive, all.negative += row.negative;
    return all;
}

double negative_share(const Environment& sky, int alpha) {
    Fluxes all;
    if (sky.is_cube()) {
        const int n = sky.cube.size();
        const std::vector<double> omega = texel_solid_angles(n);
        for (const Image<float>& face : sky.cube.faces) {
            const Fluxes flux = fluxes_of(face, alpha, [&](int x, int y) { return omega[std::size_t(y) * n + x]; });
            all.positive += flux.positive, all.negative += flux.negative;
        }
    } else {
        const int w = sky.picture.width(), h = sky.picture.height();
        all = fluxes_of(sky.picture, alpha, [&](int x, int y) { return picture_weight(sky.projection, w, h, x, y); });
    }
    return all.positive > 0 ? all.negative / all.positive : 1;
}

void clamp_negative(Image<float>& image, int alpha) {
    for_rows(image.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            float* row = image.row(y);
            for (int i = 0; i < image.width() * image.channels(); ++i)
                if (row[i] < 0 && std::isfinite(row[i]) && i % image.channels() != alpha) row[i] = 0;
        }
    });
}

} // namespace

SkyFaults mend_sky(Environment& sky, const std::array<std::string, 6>& files, BadPolicy policy, int alpha) {
    std::vector<Image<float>*> images;
    if (sky.is_cube())
        for (Image<float>& face : sky.cube.faces) images.push_back(&face);
    else images.push_back(&sky.picture);

    SkyFaults faults;
    std::int64_t texels = 0;
    for (const Image<float>* image : images) {
        const BadTexels bad = find_bad(*image, largest_float, alpha);
        faults.negative += bad.negative;
        texels += bad.texels;
    }
    if (texels == 0) return faults;
    if (faults.negative > 0) faults.negative_share = negative_share(sky, alpha);
    const bool tolerated = faults.negative_share < tolerated_negative_share;
    if (!tolerated) faults.negative = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
        if (tolerated) clamp_negative(*images[i], alpha);
        try {
            faults.bad += mend(*images[i], policy, files[i], largest_float, alpha);
        } catch (const Error& error) {
            if (tolerated) throw;
            throw Error(error.refusal, error.what() + format("; its negative values are %.2g of the sky's flux, %.0e "
                                                             "are tolerated",
                                                             faults.negative_share, tolerated_negative_share));
        }
    }
    return faults;
}

} // namespace bake
