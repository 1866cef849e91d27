#include "bake/verdict/compare/default_methods.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("default_methods: displacements suit the number of triangles, and never exceed the memory of a "
              "start") {
        for (const std::int64_t triangles : {2, 500, 6000, 100000, 3000000}) {
            const std::vector<ShadeMethod> methods = default_methods(triangles);
            CAPTURE(triangles);
            REQUIRE(methods.size() == 11);
            const ShadeMethod &coarse = methods[8], &fine = methods[9], &mapped = methods[10];
            CHECK(coarse.shade == Shade::displace);
            CHECK(fine.levels > coarse.levels);
            CHECK(mapped.shade == Shade::displace_normal);
            CHECK(mapped.levels == coarse.levels);
            if (coarse.levels > 0) CHECK(double(triangles) * std::exp2(2 * coarse.levels) < 32000);
        }
    }

    TEST_CASE("first_reference_levels: four times as fine as what is judged, where that is not too many triangles") {
        for (const std::int64_t triangles : {2, 500, 6000, 70000, 100000, 300000, 3000000})
            for (const int finest : {0, 1, 3, 5, 8}) {
                const std::vector<ShadeMethod> methods = {
                    {Shade::displace, finest}, {Shade::exact}, {Shade::displace, 0}};
                const auto refined = [&](int levels) { return double(triangles) * std::exp2(2.0 * levels); };
                const int levels = first_reference_levels(triangles, methods);
                CAPTURE(triangles);
                CAPTURE(finest);
                CHECK(levels > finest);
                if (levels > finest + 1) CHECK(refined(levels) <= most_first_triangles);
                if (refined(finest + 2) <= most_first_triangles) CHECK(levels >= finest + 2);
                if (levels < most_displacement_levels) CHECK(refined(levels) >= 2e5);
            }
        CHECK(first_reference_levels(2, std::vector<ShadeMethod>{{Shade::displace, 10}}) == most_displacement_levels);
        CHECK(first_reference_levels(3000000, std::vector<ShadeMethod>{{Shade::exact}}) == 0);
    }
}
