// The text of --shape, such as torus:R=2,r=0.7.
#include "bake/surface/analytic/parametric.h"
#include "fuzz/fuzz.h"
#include <cmath>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bake;
    return fuzz::attempt([&] {
        const ParametricSurface shape(std::string_view(reinterpret_cast<const char*>(data), size));
        for (const double u : {0.0, 0.3, 1.0})
            for (const double v : {0.0, 0.6, 1.0}) {
                const Jet<double> jet = shape.jet(u, v);
                for (int k = 0; k < 3; ++k)
                    fuzz::require(std::isfinite(jet.p[k]) && std::isfinite(jet.n[k]), "points are finite");
            }
    });
}
