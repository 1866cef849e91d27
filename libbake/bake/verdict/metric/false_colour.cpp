#include "bake/verdict/metric/false_colour.h"
#include <algorithm>

namespace bake {
namespace {

/// The colours number 0, 15.94, 31.9 ... 255 of the 256, in 8-bit levels.
constexpr unsigned char knots[17][3] = {
    {0, 0, 4},      {10, 8, 34},     {29, 17, 71},    {54, 16, 107},   {81, 18, 124},  {105, 28, 129},
    {130, 38, 129}, {156, 46, 127},  {182, 55, 122},  {207, 64, 112},  {230, 81, 100}, {244, 106, 92},
    {251, 136, 97}, {254, 165, 113}, {254, 194, 135}, {253, 224, 161}, {252, 253, 191}};

} // namespace

Vec3f magma(float value) noexcept {
    const float at = 16 * std::clamp(value, 0.0f, 1.0f);
    const int k = std::min(15, int(at));
    const auto knot = [](int i) { return Vec3f(knots[i][0], knots[i][1], knots[i][2]) / 255.0f; };
    return knot(k) + (at - float(k)) * (knot(k + 1) - knot(k));
}

Image<float> false_colour(const Image<float>& errors, float largest) {
    Image<float> out(errors.width(), errors.height(), 3);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const Vec3f colour = magma(errors.data()[i] / largest);
        for (int c = 0; c < 3; ++c) out.data()[3 * i + std::size_t(c)] = colour[c];
    }
    return out;
}

} // namespace bake
