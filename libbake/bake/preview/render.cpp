#include "bake/preview/render.h"
#include "bake/base/progress.h"
#include "bake/preview/passes.h"

namespace bake {
namespace {

/// Renders all samples in one pass, and returns what `result` makes of it.
template <class Result>
auto in_one_pass(const Scene& scene, const RenderSettings& settings, PassOptions options, RenderStats* stats,
                 Progress* progress, const Result& result) {
    options.first = settings.spp + settings.spp % 2;
    Passes passes(scene, settings, options);
    if (progress) progress->start("render", passes.tile_count());
    passes.next([&](const PixelRect&, const std::vector<float>&) {
        if (progress) progress->add(1);
    });
    throw_if_interrupted();
    if (stats) *stats += passes.stats();
    return result(passes);
}

} // namespace

Image<float> render(const Scene& scene, const RenderSettings& settings, RenderStats* stats, Progress* progress) {
    return in_one_pass(scene, settings, {}, stats, progress, [](const Passes& passes) { return passes.picture(); });
}

Image<float> render_layers(const Scene& scene, const RenderSettings& settings, RenderStats* stats, Progress* progress) {
    return in_one_pass(scene, settings, {.layers = true}, stats, progress,
                       [](const Passes& passes) { return passes.layers(); });
}

Halves render_halves(const Scene& scene, const RenderSettings& settings, RenderStats* stats, Progress* progress) {
    return in_one_pass(scene, settings, {.halves = true}, stats, progress, [](const Passes& passes) {
        return Halves{passes.half(0), passes.half(1)};
    });
}

double mean_square_difference(const Halves& x, const Halves& y) noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < x.a.size(); ++i)
        sum += (double(x.a.data()[i]) - y.a.data()[i]) * (double(x.b.data()[i]) - y.b.data()[i]);
    return sum / double(std::max<std::size_t>(1, x.a.size()));
}

} // namespace bake
