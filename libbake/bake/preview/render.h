// Renders pictures of a scene: radiance, and beside it what the camera's rays hit. Passes (passes.h) gives the pictures
// on the way too.
#pragma once
#include "bake/preview/layers.h"

namespace bake {

class Progress;

/// Mean radiance per pixel of a built scene, three channels; of settings.part alone, if given. All values are finite. The
/// result does not depend on the number of threads.
Image<float> render(const Scene& scene, const RenderSettings& settings, RenderStats* stats = nullptr,
                    Progress* progress = nullptr);
/// The same with the channels of layer_channels(). A mean beyond the range of floats is 0.
Image<float> render_layers(const Scene& scene, const RenderSettings& settings, RenderStats* stats = nullptr,
                           Progress* progress = nullptr);

/// Two pictures of a scene whose noise is independent.
struct Halves {
    Image<float> a, b;
};
/// Two pictures of half of settings.spp samples per pixel each, which is rounded up to an even number.
Halves render_halves(const Scene& scene, const RenderSettings& settings, RenderStats* stats = nullptr,
                     Progress* progress = nullptr);

/// An estimate of the mean square of x - y over all values that noise does not bias: the mean of (x.a - y.a) (x.b -
/// y.b), which are independent of each other. The mean of the squares of a single pair would be too large by the sum of
/// the variances. It may come out below 0. x and y may use the same seed, which makes them more alike and the estimate
/// better. The four pictures have the same size.
double mean_square_difference(const Halves& x, const Halves& y) noexcept;

} // namespace bake
