// Specular prefilter: the sky convolved with a lobe about each direction r, one level of a mip chain per roughness.
//
//   out(r) = integral of L(l) K(r . l) dl / integral of K(r . l) dl
//
// ggx:    K(c) = c+ / ((1 - c) + alpha^2 (1 + c))^2. This is the split sum of Karis, Real Shading in Unreal Engine 4,
//         SIGGRAPH 2013 course: N = V = R, half vectors h drawn from GGX's D(h) (n . h), each weighted by n . l. The
//         density of l is then D(h) / 4 with (n . h)^2 = (1 + n . l) / 2, from which K follows, constants dropped.
//         alpha is GGX's own width; artists' (Disney) roughness r is alpha = r^2. alpha = 1 is irradiance / pi.
// phong:  K(c) = c+^n, Phong's lobe (r . l)^n about the mirror direction, given by its exponent n as in materials.
//
// The integral is a sum over all texels of the sky, clustered in a quadtree (radiance_tree.h): a sun of one texel is never
// missed, and there is no noise. A constant sky is reproduced exactly.
#pragma once
#include "bake/environment/sky/cube.h"
#include <vector>

namespace bake {

class Progress;

enum class SpecularLobe { ggx, phong };

struct PrefilterOptions {
    SpecularLobe lobe = SpecularLobe::ggx;
    /// One per level, level 0 first. ggx: alpha in [0, 1]; at 0, a mirror, texels are the mean of the sky over their area.
    /// phong: the exponent, 0 to 1e6.
    std::vector<double> roughness;
    int size = 0; ///< texels along an edge of level 0; 0: the size of the sky
};

/// Level k has max(1, size >> k) texels along an edge, as many channels as `sky`, and roughness[k]. `sky` is finite and
/// not empty. Throws Error{Refusal::usage} when roughness is empty or out of range, or size negative.
std::vector<Cube> prefilter(const Cube& sky, const PrefilterOptions& options, Progress* progress = nullptr);

} // namespace bake
