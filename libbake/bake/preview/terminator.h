// Shading normals that relief tilts away from the surface: what becomes of them, and of the light on them.
//
// A bumped normal can face away from the viewer, and light can shine on it that is below the surface. `off` leaves the
// normal as it is and only removes light from below the surface. The others mend one of the two:
//
//   flip      a normal that faces away is mirrored at the plane across the view
//   rotate    the normal is turned towards the surface's own until the mirror direction stays above the surface: Keller
//             et al., The Iray Light Transport Simulation and Rendering System, 2017, appendix A.3
//   estevez   light near the edge fades as if the bumps shadowed it: Estevez, Lecocq, Stein, A Microfacet-Based Shadowing
//             Function to Solve the Bump Terminator Problem, Ray Tracing Gems, 2019
//   chiang    the same, by a cubic in the ratio of cosines: Chiang, Li, Burley, Taming the Shadow Terminator, SIGGRAPH
//             2019 Talks
#pragma once
#include "bake/base/vec.h"

namespace bake {

enum class Terminator { off, flip, rotate, estevez, chiang };

/// The normal to shade with. `n` is the bumped normal, `surface` that of the surface without relief, `v` points to the
/// viewer; all are unit vectors, and v . surface > 0.
Vec3f mended_normal(Terminator mode, const Vec3f& n, const Vec3f& surface, const Vec3f& v) noexcept;

/// Factor on the light from direction `l`, in [0, 1]; 0 if l is below the surface.
float light_factor(Terminator mode, const Vec3f& n, const Vec3f& surface, const Vec3f& l) noexcept;

} // namespace bake
