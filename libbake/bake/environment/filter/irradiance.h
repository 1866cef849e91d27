// Irradiance of a cube: E(n) = integral of L(l) (n . l)+ over directions l, on the texels of a small cube of normals.
//
// `sh`:     L in spherical harmonics, times the band factors of the clamped cosine (pi, 2 pi / 3, pi / 4, 0, -pi / 24,
//           ...), Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001.
//           Right for skies without a sun: three bands miss a lone sun's irradiance by several per cent, and ring.
// `direct`: the sum over the sky itself, its far and even parts taken together (radiance_tree.h). Right for every sky.
//
// E is in radiance times steradian: pi for a white sky. A diffuse surface of albedo a sends out a E / pi.
#pragma once
#include "bake/environment/sky/cube.h"

namespace bake {

enum class IrradianceMethod { direct, sh };

/// Damps high bands, against the ringing of a truncated series; N bands.
enum class ShWindow {
    none,
    hann,    ///< (1 + cos(pi l / N)) / 2
    lanczos, ///< sin(pi l / N) / (pi l / N)
};

struct IrradianceOptions {
    IrradianceMethod method = IrradianceMethod::direct;
    int bands = 3;                    ///< sh: bands l = 0 ... bands - 1, that is bands^2 coefficients; 1 to 64
    ShWindow window = ShWindow::none; ///< sh
    int size = 32;                    ///< texels along an edge of the result, at least 1
    bool over_pi = false;             ///< divides by pi, as engines store it: a white sky stays white
};

/// Irradiance in the direction of every texel's centre, in cube space; as many channels as `sky`, which is finite and
/// not empty. Throws Error{Refusal::usage} when bands or size is out of range.
Cube irradiance(const Cube& sky, const IrradianceOptions& options = {});

} // namespace bake
