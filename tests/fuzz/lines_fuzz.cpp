// Files of number lines, as profiles and as patches.
#include "bake/base/number_lines.h"
#include "bake/surface/analytic/parametric.h"
#include "fuzz/fuzz.h"
#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bake;
    const fuzz::InputFile input(data, size);
    fuzz::attempt([&] {
        for (const NumberLine& line : read_number_lines(input.path()))
            for (const double value : line.values) fuzz::require(std::isfinite(value), "numbers are finite");
    });
    for (const char* shape : {"revolution:profile=", "bezier:file="})
        fuzz::attempt([&] {
            const ParametricSurface surface(shape + input.path());
            for (const double t : {0.0, 0.4, 1.0})
                for (int patch = 0; patch < surface.patches(); ++patch) surface.jet(t, 1 - t, patch);
        });
    return 0;
}
