#include "bake/surface/point/curvature.h"
#include <limits>

namespace bake {

template <class T> Jet<T> jet_of(const Jet2<T>& s, T outward) noexcept {
    Jet<T> jet{.p = s.p, .p_u = s.p_u, .p_v = s.p_v, .n = Vec3<T>(0), .n_u = Vec3<T>(0), .n_v = Vec3<T>(0), .sigma = 0};
    const Vec3<T> N = glm::cross(s.p_u, s.p_v);
    const T square = glm::dot(N, N);
    // If the derivatives are parallel, N is only rounding noise.
    constexpr T noise = 4 * std::numeric_limits<T>::epsilon();
    if (!(square > noise * noise * glm::dot(s.p_u, s.p_u) * glm::dot(s.p_v, s.p_v))) return jet;
    const T per_area = 1 / std::sqrt(square),
            scale = outward * per_area; // one root and one division, the slow operations, for all terms
    const Vec3<T> n = per_area * N;
    const auto derivative = [&](const Vec3<T>& dN) { return scale * (dN - glm::dot(dN, n) * n); };
    jet.n = outward * n;
    jet.n_u = derivative(glm::cross(s.p_uu, s.p_v) + glm::cross(s.p_u, s.p_uv));
    jet.n_v = derivative(glm::cross(s.p_uv, s.p_v) + glm::cross(s.p_u, s.p_vv));
    jet.sigma = outward;
    return jet;
}

template <class T> Curvature<T> curvature(const Jet<T>& s) noexcept {
    Curvature<T> c{.e1 = Vec3<T>(0), .e2 = Vec3<T>(0)};
    const Vec3<T> x = unit_or_zero(s.p_u);
    const Vec3<T> y = glm::cross(s.n, x); // n is unit and perpendicular to p_u
    const T u = glm::dot(s.p_u, x), shear = glm::dot(s.p_v, x), v = glm::dot(s.p_v, y);
    if (s.sigma == T(0) || !(u * std::abs(v) > T(0))) return c;
    // A in the orthonormal frame (x, y), made symmetric, because normals of meshes are interpolated.
    const Vec3<T> n_x = s.n_u / u, n_y = (s.n_v - shear * n_x) / v;
    const T xx = glm::dot(n_x, x), yy = glm::dot(n_y, y), xy = (glm::dot(n_x, y) + glm::dot(n_y, x)) / 2;
    const T half = (xx - yy) / 2, root = std::hypot(half, xy);
    c.mean = (xx + yy) / 2;
    c.a1 = c.mean + root;
    c.a2 = c.mean - root;
    c.gauss = xx * yy - xy * xy;
    // The angle from x to e1 is half the angle of (half, xy).
    const T angle = root > T(0) ? std::atan2(xy, half) / 2 : T(0);
    c.e1 = std::cos(angle) * x + std::sin(angle) * y;
    c.e2 = glm::cross(s.n, c.e1);
    return c;
}

template Jet<float> jet_of(const Jet2<float>&, float) noexcept;
template Jet<double> jet_of(const Jet2<double>&, double) noexcept;
template Curvature<float> curvature(const Jet<float>&) noexcept;
template Curvature<double> curvature(const Jet<double>&) noexcept;

} // namespace bake
