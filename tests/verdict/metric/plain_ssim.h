// SSIM written down from the paper a second time, in double, with two-dimensional weights.
#pragma once
#include "bake/picture/image.h"
#include <cmath>

namespace bake::test {

/// SSIM of one window from its definition: weighted means, then weighted mean products of the differences from them.
inline double plain_ssim(const Image<float>& a, const Image<float>& b, int left, int top) {
    double total = 0, mean_a = 0, mean_b = 0, aa = 0, bb = 0, ab = 0;
    const auto each = [&](const auto& visit) {
        for (int y = 0; y < 11; ++y)
            for (int x = 0; x < 11; ++x) {
                const double w = std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / (2 * 1.5 * 1.5));
                visit(w, double(a.at(left + x, top + y)), double(b.at(left + x, top + y)));
            }
    };
    each([&](double w, double va, double vb) { total += w, mean_a += w * va, mean_b += w * vb; });
    mean_a /= total, mean_b /= total;
    each([&](double w, double va, double vb) {
        aa += w / total * (va - mean_a) * (va - mean_a);
        bb += w / total * (vb - mean_b) * (vb - mean_b);
        ab += w / total * (va - mean_a) * (vb - mean_b);
    });
    const double c1 = 1e-4, c2 = 9e-4;
    return (2 * mean_a * mean_b + c1) / (mean_a * mean_a + mean_b * mean_b + c1) * (2 * ab + c2) / (aa + bb + c2);
}

} // namespace bake::test
