// A sky convolved with a lobe about each direction, by the quadtree of radiance_tree.h.
//
//   light(n) = sum over nodes of F K + K' n . D       white(n) = sum over nodes of omega K
//   out(n) = (light(n) + (I - white(n)) E) / I
//
// with K at a node's centre, its even spread included; I the lobe's integral, and E the sky's level outside its suns. So
// white stays white whatever the nodes leave out, and suns, which are opened to their texels, are exact. Lobes about as
// narrow as a texel have out = light / white.
//
// Barnes and Hut, A hierarchical O(N log N) force-calculation algorithm, Nature 1986. Tiles of 8 x 8 directions share a
// walk, which opens a node while the lobe changes too much across it, or while its light is too uneven.
#pragma once
#include "bake/environment/filter/lobe.h"
#include "bake/environment/filter/radiance_tree.h"

namespace bake {

/// Width of a lobe about its centre, radians; of the clamped cosine, which has none of its own, 2.
template <class Lobe> float width_of(const Lobe& lobe) noexcept {
    return 1 / std::sqrt(std::max(lobe.sharpness(), 0.25f));
}

/// The level of a tree over a sky of that size that is fine enough for lobes as wide: eight nodes to a width and 512 to
/// an edge, which keep a sun's flux, place and size.
int finest_level_for(int sky_size, float lobe_width) noexcept;

struct ConvolveOptions {
    /// Largest node, over the width of the lobe there: how exactly even light is summed.
    float node_width = 0.5f;
    /// What uneven light in one node may add to the error, over the mean of the sky: how far suns are opened.
    float tolerance = 1e-4f;
};

/// The convolution at the centres of the texels of a cube of `size` texels along an edge.
template <class Lobe>
Cube convolve(const RadianceTree& tree, const Lobe& lobe, int size, const ConvolveOptions& options = {});

} // namespace bake
