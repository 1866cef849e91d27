#include "bake/surface/analytic/taylor.h"
#include "bake/base/vec.h"

namespace bake {
namespace {

constexpr double two_pi = 2 * pi;

struct CosSin {
    double cos, sin;
};

CosSin cos_sin(double x) noexcept {
    const double rest = x - std::floor(x); // in [0, 1]
    const int quarter = int(4 * rest + 0.5);
    const double angle = two_pi * (rest - 0.25 * quarter), c = std::cos(angle), s = std::sin(angle);
    switch (quarter & 3) {
    case 0: return {c, s};
    case 1: return {-s, c};
    case 2: return {-c, -s};
    default: return {s, -c};
    }
}

} // namespace

TaylorCosSin cos_sin(const Taylor& x) noexcept {
    const auto [c, s] = cos_sin(x.f);
    const double k = two_pi;
    return {chain(x, c, -k * s, -k * k * c), chain(x, s, k * c, -k * k * s)};
}

Taylor abs_power(const Taylor& x, double n) noexcept {
    const double size = std::abs(x.f), sign = x.f < 0 ? -1.0 : 1.0;
    return chain(x, std::pow(size, n), n * std::pow(size, n - 1) * sign, n * (n - 1) * std::pow(size, n - 2));
}

Taylor power(const Taylor& x, double n) noexcept {
    return chain(x, std::pow(x.f, n), n * std::pow(x.f, n - 1), n * (n - 1) * std::pow(x.f, n - 2));
}

Jet2<double> derivatives_of(const TaylorPoint& point) noexcept {
    const auto& [x, y, z] = point;
    return {{x.f, y.f, z.f},    {x.u, y.u, z.u},    {x.v, y.v, z.v},
            {x.uu, y.uu, z.uu}, {x.uv, y.uv, z.uv}, {x.vv, y.vv, z.vv}};
}

} // namespace bake
