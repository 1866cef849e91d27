#include "bake/verdict/metric/flip_filters.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// A term a sqrt(pi/b) exp(-pi^2 x^2 / b) of a contrast sensitivity function, x in degrees: table 1 of the paper.
struct Term {
    double a, b;
    double sigma() const { return std::sqrt(b / (2 * pi * pi)); } ///< degrees
};
constexpr Term luminance_term{1, 0.0047}, red_green_term{1, 0.0053},
    blue_yellow_terms[] = {{34.1, 0.04}, {13.5, 0.025}};

/// Width of the features in degrees: section 4.2.
constexpr double feature_width = 0.082;

/// Scales the positive weights to the sum 1, and the negative ones to -1.
void balance(std::vector<double>& weights) {
    double positive = 0, negative = 0;
    for (const double w : weights) (w > 0 ? positive : negative) += w;
    for (double& w : weights) w /= w > 0 ? positive : -negative;
}

/// The channels of a picture in rows of one value per pixel, with margins on all four sides.
struct Opponents {
    Rows<float> y, cx, cz;
};

Opponents opponents(const Image<float>& picture, const FlipColour& space, int begin, int end, int margin) {
    const auto rows = [&] { return Rows<float>(picture.width(), end - begin + 2 * margin, margin); };
    Opponents out{rows(), rows(), rows()};
    for (int i = 0; i < out.y.count(); ++i) {
        const float* p = picture.row(std::clamp(begin - margin + i, 0, picture.height() - 1));
        float *y = out.y[i], *cx = out.cx[i], *cz = out.cz[i];
        for (int x = 0; x < picture.width(); ++x, p += 3) {
            const Vec3f v = space.opponent(glm::clamp(Vec3f(p[0], p[1], p[2]), 0.0f, 1.0f));
            y[x] = v.x, cx[x] = v.y, cz[x] = v.z;
        }
    }
    for (Rows<float>* channel : {&out.y, &out.cx, &out.cz}) repeat_ends(*channel);
    return out;
}

void add_colour(const Opponents& in, const FlipFilters& f, const FlipColour& space, FlipBand& band) {
    const auto filtered = [&](const Rows<float>& channel, const std::vector<double>& weights) {
        return along_columns(along_rows(channel, weights), weights, f.margin);
    };
    const Rows<float> y = filtered(in.y, f.luminance), cx = filtered(in.cx, f.red_green),
                      cz_0 = filtered(in.cz, f.blue_yellow[0]), cz_1 = filtered(in.cz, f.blue_yellow[1]);
    const auto share_0 = float(f.blue_yellow_share[0]), share_1 = float(f.blue_yellow_share[1]);
    band.colour.reserve(std::size_t(y.count()) * std::size_t(y.width()));
    for (int i = 0; i < y.count(); ++i)
        for (int x = 0; x < y.width(); ++x) {
            const Vec3f v(y[i][x], cx[i][x], share_0 * cz_0[i][x] + share_1 * cz_1[i][x]);
            band.colour.push_back(hunt(space.lab(glm::clamp(space.linear(v), 0.0f, 1.0f))));
        }
}

void add_features(const Rows<float>& luminance, const FlipFilters& f, FlipBand& band) {
    const Rows<float> smooth = along_rows(luminance, f.smooth), edge = along_rows(luminance, f.edge),
                      point = along_rows(luminance, f.point);
    const Rows<float> edge_x = along_columns(edge, f.smooth, f.margin),
                      edge_y = along_columns(smooth, f.edge, f.margin),
                      point_x = along_columns(point, f.smooth, f.margin),
                      point_y = along_columns(smooth, f.point, f.margin);
    // Weights that sum to 0 do not see the -16 of the luminance; 116 is its range.
    const auto strength = [](float x, float y) { return std::sqrt(x * x + y * y) / 116; };
    for (int i = 0; i < edge_x.count(); ++i)
        for (int x = 0; x < edge_x.width(); ++x) {
            band.edge.push_back(strength(edge_x[i][x], edge_y[i][x]));
            band.point.push_back(strength(point_x[i][x], point_y[i][x]));
        }
}

} // namespace

FlipFilters::FlipFilters(double pixels_per_degree) {
    // All filters of colour have the radius of the widest Gaussian, three standard deviations.
    const int radius = int(std::ceil(3 * blue_yellow_terms[0].sigma() * pixels_per_degree));
    const auto weights = [&](const Term& term) { return gaussian_weights(term.sigma() * pixels_per_degree, radius); };
    luminance = weights(luminance_term);
    red_green = weights(red_green_term);
    double total = 0;
    for (int i = 0; i < 2; ++i) {
        const Term& term = blue_yellow_terms[i];
        blue_yellow[i] = weights(term);
        // The sum over the lattice of the term itself: gaussian_weights() divided by it, once per axis.
        const double sum = 1 / blue_yellow[i][std::size_t(radius)];
        total += blue_yellow_share[i] = term.a * std::sqrt(pi / term.b) * sum * sum;
    }
    for (double& share : blue_yellow_share) share /= total;

    const double sigma = 0.5 * feature_width * pixels_per_degree;
    const int feature_radius = int(std::ceil(3 * sigma));
    smooth = gaussian_weights(sigma, feature_radius);
    for (int i = -feature_radius; i <= feature_radius; ++i) {
        const double g = smooth[std::size_t(i + feature_radius)], x = i / sigma;
        edge.push_back(-x * g);
        point.push_back((x * x - 1) * g);
    }
    balance(edge);
    balance(point);
    margin = std::max(radius, feature_radius);
}

FlipBand flip_band(const Image<float>& picture, const FlipFilters& filters, const FlipColour& space, int begin,
                   int end) {
    FlipBand band;
    const Opponents in = opponents(picture, space, begin, end, filters.margin);
    add_colour(in, filters, space, band);
    add_features(in.y, filters, band);
    return band;
}

} // namespace bake
