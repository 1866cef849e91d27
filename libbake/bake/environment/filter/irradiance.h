// Irradiance of a cube: E(n) = integral of L(l) (n . l)+ over directions l, on the texels of a small cube of normals.
//
// `sh`:     L in spherical harmonics, times the band factors of the clamped cosine (pi, 2 pi / 3, pi / 4, 0, -pi / 24,
//           ...), Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001.
//           Accurate for skies without a sun. With a single sun three bands are wrong by several per cent, and ring.
// `direct`: the sum over all texels of the sky, clustered in a quadtree (radiance_tree.h). Accurate for every sky.
//
// E is in radiance times steradian: pi for a white sky. A diffuse surface of albedo a reflects the radiance a E / pi.
#pragma once
#include "bake/environment/sky/cube.h"

namespace bake {

class Progress;

enum class IrradianceMethod { direct, sh };

struct IrradianceOptions {
    IrradianceMethod method = IrradianceMethod::direct;
    int bands = 3; ///< sh: bands l = 0 ... bands - 1, that is bands^2 coefficients; 1 to 64
    int size = 32; ///< texels along an edge of the result, at least 1
};

/// Irradiance in the direction of every texel's centre, in cube space; as many channels as `sky`, which is finite and
/// not empty. Throws Error{Refusal::usage} when bands or size is out of range.
Cube irradiance(const Cube& sky, const IrradianceOptions& options = {}, Progress* progress = nullptr);

} // namespace bake
