// The sky that a file holds, as six plain faces.
#pragma once
#include "bake/environment/sky/environment.h"

namespace bake {

/// The faces of an environment, with three channels and texel centres inside the faces: its own, or those that bilinear
/// interpolation gives, as fine as the environment (Environment::face_edge).
Cube sky_cube(Environment sky);

} // namespace bake
