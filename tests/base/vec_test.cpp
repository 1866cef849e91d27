#include "bake/base/vec.h"
#include <doctest/doctest.h>
#include <limits>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE_TEMPLATE("vec: unit_or_zero is a unit vector or exactly zero, never NaN", T, float, double) {
        const T most = std::numeric_limits<T>::max(), infinite = std::numeric_limits<T>::infinity(),
                none = std::numeric_limits<T>::quiet_NaN();
        for (const Vec3<T>& v : {Vec3<T>(1, 2, 3), Vec3<T>(-1, 0, 0), Vec3<T>(most, 0, 0), Vec3<T>(most, -most, most),
                                 Vec3<T>(most / 4, 1, 0)})
            CHECK(glm::length(unit_or_zero(v)) == doctest::Approx(1).epsilon(1e-6));
        CHECK(unit_or_zero(Vec3<T>(0, most, most)).y == doctest::Approx(0.70710678));
        for (const Vec3<T>& v : {Vec3<T>(0), Vec3<T>(none, 1, 1), Vec3<T>(infinite, 0, 0), Vec3<T>(1, -infinite, 2),
                                 Vec3<T>(none, infinite, most)})
            CHECK(unit_or_zero(v) == Vec3<T>(0));
    }

} // TEST_SUITE
