// A sky to see with which way a program turns environments: every face says its name and where its axes go.
#pragma once
#include "bake/environment/sky/cube.h"

namespace bake {

/// Three channels in [0, 1], linear. Each face: its axis in large letters, its name below; an arrow to the right and one
/// down, with the axis that lies there; a white square in the corner of texel (0, 0); a grid of eighths, and a faint
/// checker of single texels. Readable from 64 texels on.
Cube label_sky(int size);

} // namespace bake
