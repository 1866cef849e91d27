// Skies of fewer texels: smaller faces, or a series of spherical harmonics.
#pragma once
#include "bake/environment/sky/cube.h"

namespace bake {

/// The series comes first; its faces may be reduced too.
struct SkyReduction {
    int face_size = 0; ///< larger faces are reduced to so many texels along an edge; 0: faces stay
    int sh_bands = 0;  ///< bands of spherical harmonics instead of the faces; 1 is the mean of the sky; 0: the faces
};

/// Texels along an edge of the faces that show a series of so many bands: about four across the half wave of the highest
/// band; 1 for one band.
int face_of_bands(int bands) noexcept;

/// Of a series the values at the texels' centres, 0 where it rings below zero; smaller faces by the mean over each texel
/// (resize_by_area()). Not of an empty sky.
Cube reduced(Cube sky, const SkyReduction& reduction);

} // namespace bake
