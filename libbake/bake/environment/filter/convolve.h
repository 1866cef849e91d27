// Convolution of a sky with a lobe about each direction, by the quadtree of radiance_tree.h.
//
//   light(n) = sum over nodes of F K + K' n . D       white(n) = sum over nodes of omega K
//   out(n) = (light(n) + (I - white(n)) E) / I
//
// with K evaluated at the node centre plus a second-moment correction, I the integral of the lobe, and E the mean radiance of
// the sky outside its suns. A constant sky is reproduced exactly; bright texels are always traversed down to the leaves, so
// their contribution is exact. For lobes about as narrow as a texel, out = light / white.
//
// Barnes and Hut, A hierarchical O(N log N) force-calculation algorithm, Nature 1986. Tiles of 8 x 8 directions share one
// traversal, which descends into a node while the lobe varies too much across it, or while its radiance is too uneven.
#pragma once
#include "bake/environment/filter/lobe.h"
#include "bake/environment/filter/radiance_tree.h"

namespace bake {

class Progress;

/// Width of a lobe about its centre, radians; 2 for the clamped cosine.
template <class Lobe> float width_of(const Lobe& lobe) noexcept {
    return 1 / std::sqrt(std::max(lobe.sharpness(), 0.25f));
}

/// The coarsest level of a tree over a sky of `sky_size` texels that is fine enough for a lobe: at least eight nodes per
/// width of the lobe and 512 nodes along an edge, which preserve the flux, the position and the size of a sun.
int finest_level_for(int sky_size, float lobe_width) noexcept;

struct ConvolveOptions {
    /// Largest node, relative to the width of the lobe there: sets the accuracy where radiance is even.
    float node_width = 0.5f;
    /// Largest error from uneven radiance in one node, relative to the mean of the sky: sets where nodes are subdivided.
    float tolerance = 1e-4f;
};

/// The convolution at the centres of the texels of a cube of `size` texels along an edge.
template <class Lobe>
Cube convolve(const RadianceTree& tree, const Lobe& lobe, int size, const ConvolveOptions& options = {},
              Progress* progress = nullptr);

} // namespace bake
