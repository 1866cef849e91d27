#include "relief/map/torus_relief.h"
#include <doctest/doctest.h>
#include <map>

using namespace bake;
using oracle::TorusRelief;

TEST_SUITE("oracle") {

    TEST_CASE("normal_map: exact stays exact as the torus relief grows, blinn falls behind with its height, "
              "constant-scale is "
              "off at any") {
        const Mesh mesh = oracle::torus_mesh(512, 256);
        const BakeTarget target = make_bake_target(mesh, "torus", 512, 512);
        std::map<NormalMethod, double> low, high;
        for (const double A : {0.001, 0.01, 0.04}) {
            const TorusRelief r{A, 24, 12};
            const HeightTexture height = oracle::relief_texture(r, 512);
            for (const NormalMethod method : all_normal_methods) {
                const NormalMapOptions options = oracle::relief_options(r, 512, Filter::c2, method);
                NormalMapReport report;
                const Image<float> map = normal_map(
                    HeightField(height, options.height_options, options.filter, 512, 512), target, options, report);
                const auto e = oracle::spread(oracle::map_errors(
                    map, target, 0, [&](double u, double v) { return oracle::relief_normal(r, u, v); }));
                MESSAGE("A " << A << ", " << std::string(name(method)) << ": mean " << e.mean << ", p95 " << e.p95
                             << ", max " << e.max << " deg");
                (A < 0.01 ? low : high)[method] = e.mean;
            }
        }
        // On a tube of curvature 2.5 the relief reaches b a = .0025 and .1.
        CHECK(high[NormalMethod::exact] < 0.01);
        CHECK(high[NormalMethod::blinn] > 100 * low[NormalMethod::blinn]);
        CHECK(high[NormalMethod::surface_gradient] == doctest::Approx(high[NormalMethod::blinn]).epsilon(0.001));
        CHECK(low[NormalMethod::constant_scale] > 50 * low[NormalMethod::blinn]);
    }
}
