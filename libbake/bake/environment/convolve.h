// A sky convolved with a lobe about each direction, by the quadtree of radiance_tree.h.
//
//   out(n) = sum over nodes (F K + K' n . D) / sum over nodes omega K,     K at the node's centre, its spread included
//
// Barnes and Hut, A hierarchical O(N log N) force-calculation algorithm, Nature 1986: tiles of directions share one walk,
// which opens a node while the lobe changes too much across it. Divided by the same sum of a white sky, so that white
// stays white whatever is left out.
#pragma once
#include "bake/environment/lobe.h"
#include "bake/environment/radiance_tree.h"

namespace bake {

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
