#include "bake/verdict/plan/part_verification.h"
#include "bake/base/progress.h"
#include "bake/verdict/plan/error_meter.h"
#include "bake/verdict/plan/texture_plan.h"
#include <algorithm>
#include <limits>

namespace bake {
namespace {

constexpr int all_pixels = std::numeric_limits<int>::max();

std::vector<const Material*> materials_of(const Scene& scene, const SceneTexture& texture) {
    std::vector<const Material*> materials;
    for (const int m : texture.materials) materials.push_back(scene.materials[std::size_t(m)].get());
    return materials;
}

/// The scene with one map at full size in RGB of 8 bits.
Scene with_rgb8(const Scene& shown, const SceneTexture& in_shown, const SceneTexture& source) {
    Scene twin = twin_of(shown);
    const Image<float>& full = *source.picture;
    set_texture(twin, in_shown.materials, source.use, stored(full, source.use, {0, full.width(), full.height(), 3, 8}));
    return twin;
}

class PartVerifier {
public:
    PartVerifier(const PlanWork& work, const ScenePlan& plan, const Scene& reference, const Scene& shown)
        : work_(work), plan_(plan), reference_(reference), shown_(shown) {}

    Verification line(std::size_t camera, const ObjectMask& objects, const std::string& name) const;
    Verification line_of_map(std::size_t camera, const SceneTexture& source, const SceneTexture& in_shown,
                             const TexturePlan& map) const;

private:
    ErrorMeter meter(std::size_t camera, const ObjectMask& objects, const std::string& name,
                     Budget::Metric metric) const {
        const ProbedScene both[] = {{&reference_, objects}, {&shown_, objects}};
        ProbeOptions options = probe_options(work_, camera, "verify " + name);
        options.exposure = plan_.exposure;
        return {metric, both[0], object_pixels(both, options), options};
    }

    const PlanWork& work_;
    const ScenePlan& plan_;
    const Scene &reference_, &shown_;
};

Verification PartVerifier::line(std::size_t camera, const ObjectMask& objects, const std::string& name) const {
    ErrorMeter own = meter(camera, objects, name, work_.options.budget.metric);
    Verification line{.camera = work_.scenes.cameras()[camera].name, .object = name};
    line.measured = own.measure({&shown_, objects}, all_pixels);
    line.flip = own.pixels() > 0 ? own.flip({&shown_, objects}) : 0;
    line.within = line.measured.low() <= StoppingRule{}.pass_at * work_.options.budget.value;
    return line;
}

Verification PartVerifier::line_of_map(std::size_t camera, const SceneTexture& source, const SceneTexture& in_shown,
                                       const TexturePlan& map) const {
    const ObjectMask objects = objects_with(reference_, materials_of(reference_, source));
    Verification one = line(camera, objects, map.file);
    one.predicted = map.error;
    if (map.rgb8_rmse < 0 || one.measured.pixels == 0) return one;
    const Scene rgb8 = with_rgb8(shown_, in_shown, source);
    ErrorMeter own = meter(camera, objects, map.file, Budget::Metric::rmse);
    const double most = StoppingRule{}.pass_at * own.measure({&rgb8, objects}, all_pixels).rmse();
    one.measured = own.measure({&shown_, objects}, all_pixels);
    one.within = one.measured.rmse() <= most;
    return one;
}

} // namespace

std::vector<Verification> verify_parts(const PlanWork& work, const ScenePlan& plan, const SceneEntries& given,
                                       const Scene& reference, const SceneEntries& planned, const Scene& shown) {
    const PartVerifier verifier(work, plan, reference, shown);
    const std::vector<SceneTexture> sources = scene_textures(reference, &given);
    const std::vector<SceneTexture> in_shown = scene_textures(shown, &planned);
    const std::size_t maps = std::min({sources.size(), in_shown.size(), plan.textures.size()});
    std::vector<Verification> verified;
    for (std::size_t camera = 0; camera < work.scenes.cameras().size(); ++camera) {
        if (work.progress) work.progress->start("verify " + work.scenes.cameras()[camera].name, 0);
        for (std::size_t i = 0; i < maps; ++i) {
            Verification line = verifier.line_of_map(camera, sources[i], in_shown[i], plan.textures[i]);
            if (line.measured.pixels > 0) verified.push_back(std::move(line));
        }
        verified.push_back(verifier.line(camera, {}, ""));
    }
    return verified;
}

} // namespace bake
