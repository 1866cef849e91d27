#include "bake/verdict/compare/cause_judge.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr double rendered_pixels = 2000;

std::vector<std::uint32_t> object_instances(const MethodScene& scene) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 0; i < scene.of_object.size(); ++i)
        if (scene.of_object[i]) numbers.push_back(std::uint32_t(i));
    return numbers;
}

} // namespace

CauseJudge::CauseJudge(const ComparedScene& scene, const ShadeMethod& reference, float exposure,
                       std::int64_t object_pixels)
    : scene_(scene), reference_(scene.load_unfiltered(reference)), reference_base_(scene.load_base(reference)) {
    options_.settings = scene.settings();
    options_.exposure = exposure;
    options_.stride = std::max(1, int(std::lround(std::sqrt(double(object_pixels) / rendered_pixels))));
}

CauseShares CauseJudge::shares(const ShadeMethod& method, Progress* progress) const {
    const MethodScene own = scene_.load(method);
    CauseScenes scenes{.method = &own.scene,
                       .reference = &reference_.scene,
                       .reference_base = &reference_base_,
                       .object = object_instances(own)};
    Scene base;
    if (displaces(method.shade)) {
        base = scene_.load_base(method);
        scenes.method_base = &base;
    }
    return cause_shares(scenes, options_, progress);
}

} // namespace bake
