#include "bake/relief/displace/mitre.h"
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace bake {

Vec3d mitre(std::span<const Vec3d> normals) {
    Vec3d sum(0);
    glm::dmat3 products(0);
    for (const Vec3d& n : normals) sum += n, products += glm::outerProduct(n, n);
    // The products alone are singular: two normals leave one direction free, one normal and nearly equal ones leave two. With
    // a damping small enough to give m in one step, the determinant would be less than its rounding. So the damping is large,
    // and each step divides the rest along an eigenvector by 1 + eigenvalue / damping.
    const double damping = 0.01 * double(normals.size());
    const glm::dmat3 damped = glm::inverse(products + glm::dmat3(damping));
    Vec3d m(0);
    for (int step = 0; step < 8; ++step) m += damped * (sum - products * m);
    const double length = glm::length(m);
    return length > longest_mitre ? longest_mitre / length * m : m;
}

} // namespace bake
