// FLIP written down from the paper a second time, in double, with two-dimensional kernels: slow, and as plain as can be.
#pragma once
#include "bake/picture/image.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace bake::test {

struct PlainFlip {
    using Vec = std::array<double, 3>;
    const Image<float>&a, &b;
    double ppd;

    static constexpr double pi = std::numbers::pi;

    // IEC 61966-2-1's primaries with the white (0.31271, 0.32902), as fractions.
    static Vec xyz(const Vec& c) {
        return {(10135552 * c[0] + 8788810 * c[1] + 4435075 * c[2]) / 24577794,
                (2613072 * c[0] + 8788810 * c[1] + 887015 * c[2]) / 12288897,
                (1425312 * c[0] + 8788810 * c[1] + 70074185 * c[2]) / 73733382};
    }
    static Vec rgb(const Vec& v) {
        // Cramer's rule on the columns of xyz().
        const Vec r = xyz({1, 0, 0}), g = xyz({0, 1, 0}), b = xyz({0, 0, 1});
        const auto det = [](const Vec& p, const Vec& q, const Vec& s) {
            return p[0] * (q[1] * s[2] - q[2] * s[1]) - q[0] * (p[1] * s[2] - p[2] * s[1]) +
                   s[0] * (p[1] * q[2] - p[2] * q[1]);
        };
        const double d = det(r, g, b);
        return {det(v, g, b) / d, det(r, v, b) / d, det(r, g, v) / d};
    }
    static Vec clamped(Vec c) {
        for (double& v : c) v = std::clamp(v, 0.0, 1.0);
        return c;
    }
    static Vec opponent(const Vec& c) {
        const Vec v = xyz(c), w = xyz({1, 1, 1});
        return {116 * v[1] / w[1] - 16, 500 * (v[0] / w[0] - v[1] / w[1]), 200 * (v[1] / w[1] - v[2] / w[2])};
    }
    static Vec from_opponent(const Vec& o) {
        const Vec w = xyz({1, 1, 1});
        const double y = (o[0] + 16) / 116;
        return rgb({w[0] * (y + o[1] / 500), w[1] * y, w[2] * (y - o[2] / 200)});
    }
    static Vec lab_hunt(const Vec& c) {
        const Vec v = xyz(c), w = xyz({1, 1, 1});
        const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29; };
        const double x = f(v[0] / w[0]), y = f(v[1] / w[1]), z = f(v[2] / w[2]), l = 116 * y - 16;
        return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
    }
    static double hyab(const Vec& p, const Vec& q) {
        return std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]);
    }

    Vec at(const Image<float>& p, int x, int y) const {
        x = std::clamp(x, 0, p.width() - 1), y = std::clamp(y, 0, p.height() - 1);
        return opponent(clamped({p.at(x, y, 0), p.at(x, y, 1), p.at(x, y, 2)}));
    }

    /// The channel under a kernel; positive and negative weights are scaled to 1 and -1.
    double filtered(const Image<float>& p, int x, int y, int c, int radius,
                    const std::function<double(double, double)>& kernel) const {
        double positive = 0, negative = 0, up = 0, down = 0;
        for (int j = -radius; j <= radius; ++j)
            for (int i = -radius; i <= radius; ++i) {
                const double w = kernel(i, j), v = at(p, x + i, y + j)[c];
                if (w > 0) positive += w, up += w * v;
                else negative -= w, down += w * v;
            }
        return up / positive + (negative > 0 ? down / negative : 0);
    }

    Vec colour(const Image<float>& p, int x, int y) const {
        const double terms[3][4] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
        const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
        Vec out;
        for (int c = 0; c < 3; ++c) {
            const double* t = terms[c];
            out[c] = filtered(p, x, y, c, radius, [&](double i, double j) {
                const double z = (i * i + j * j) / (ppd * ppd);
                return t[0] * std::sqrt(pi / t[1]) * std::exp(-pi * pi * z / t[1]) +
                       t[2] * std::sqrt(pi / t[3]) * std::exp(-pi * pi * z / t[3]);
            });
        }
        return lab_hunt(clamped(from_opponent(out)));
    }

    double feature(const Image<float>& p, int x, int y, bool point) const {
        const double s = 0.5 * 0.082 * ppd;
        const auto along = [&](bool swapped) {
            return filtered(p, x, y, 0, int(std::ceil(3 * s)), [=](double i, double j) {
                if (swapped) std::swap(i, j);
                const double g = std::exp(-(i * i + j * j) / (2 * s * s));
                return point ? (i * i / (s * s) - 1) * g : -i * g;
            });
        };
        return std::hypot(along(false), along(true)) / 116;
    }

    double error(int x, int y) const {
        const double largest = std::pow(hyab(lab_hunt({0, 1, 0}), lab_hunt({0, 0, 1})), 0.7);
        const double power = std::pow(hyab(colour(a, x, y), colour(b, x, y)), 0.7);
        const double c = power < 0.4 * largest ? 0.95 / (0.4 * largest) * power
                                               : 0.95 + (power - 0.4 * largest) / (0.6 * largest) * 0.05;
        const double edge = std::abs(feature(a, x, y, false) - feature(b, x, y, false)),
                     point = std::abs(feature(a, x, y, true) - feature(b, x, y, true));
        return std::pow(c, 1 - std::sqrt(std::max(edge, point) / std::numbers::sqrt2));
    }
};

} // namespace bake::test
