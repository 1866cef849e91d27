#include "bake/environment/filter/prefilter.h"
#include "bake/base/error.h"
#include "bake/environment/filter/convolve.h"
#include "bake/environment/filter/mips.h"
#include <algorithm>
#include <cmath>
#include <string>

namespace bake {
namespace {

void check(const PrefilterOptions& options) {
    const auto refuse = [](const std::string& message) { throw Error(Refusal::usage, message); };
    if (options.roughness.empty()) refuse("`roughness`: is empty; give one value for each level, such as 0,0.1,0.3,1");
    if (options.size < 0)
        refuse("`size` " + std::to_string(options.size) + ": is negative; give 0 for the size of the sky");
    for (const double value : options.roughness) {
        if (options.lobe == SpecularLobe::ggx && !(value >= 0 && value <= 1))
            refuse("`roughness` " + std::to_string(value) + ": is not an alpha of GGX; give 0 to 1");
        if (options.lobe == SpecularLobe::phong && !(value >= 0 && value <= 1e6))
            refuse("`roughness` " + std::to_string(value) + ": is not an exponent of Phong's lobe; give 0 to 1e6");
    }
}

} // namespace

std::vector<Cube> prefilter(const Cube& sky, const PrefilterOptions& options, Progress* progress) {
    check(options);
    const bool ggx = options.lobe == SpecularLobe::ggx;
    float narrowest = 2;
    for (const double value : options.roughness)
        if (!ggx || value > 0)
            narrowest =
                std::min(narrowest, ggx ? width_of(GgxLobe::of_alpha(value)) : width_of(PhongLobe{float(value)}));
    const RadianceTree tree(sky, finest_level_for(sky.size(), narrowest));

    const int first = options.size == 0 ? sky.size() : options.size;
    std::vector<Cube> chain;
    for (std::size_t level = 0; level < options.roughness.size(); ++level) {
        const int size = std::max(1, level < 31 ? first >> level : 0);
        const double value = options.roughness[level];
        if (!ggx) chain.push_back(convolve(tree, PhongLobe{float(value)}, size, {}, progress));
        else if (value > 0) chain.push_back(convolve(tree, GgxLobe::of_alpha(value), size, {}, progress));
        else chain.push_back(resize_by_area(sky, size));
    }
    return chain;
}

} // namespace bake
