#include "bake/light/bsdf.h"
#include <algorithm>
#include <cmath>

namespace bake {

template <class T>
Vec3<T> reflected(const BlinnPhong<T>& surface, const Vec3<T>& n, const Vec3<T>& l, const Vec3<T>& v) noexcept {
    const T n_l = glm::dot(n, l);
    if (!(n_l > T(0))) return Vec3<T>(T(0));
    const T n_h = std::max(T(0), glm::dot(n, unit_or_zero(l + v))); // unit_or_zero is 0 for l = -v
    return surface.diffuse * n_l + surface.specular * std::pow(n_h, surface.shininess);
}

template Vec3f reflected(const BlinnPhong<float>&, const Vec3f&, const Vec3f&, const Vec3f&) noexcept;
template Vec3d reflected(const BlinnPhong<double>&, const Vec3d&, const Vec3d&, const Vec3d&) noexcept;

} // namespace bake
