// A test sky that shows how a program orients environments: every face is labelled with its name and its axes.
#pragma once
#include "bake/environment/sky/cube.h"

namespace bake {

/// Three channels in [0, 1], linear. Each face has its axis in large letters and its name below, an arrow to the right and an
/// arrow down with the axes in these directions, a white square in the corner of texel (0, 0), a grid of eighths, and a
/// faint checker of single texels. The text is readable from 64 texels on.
Cube label_sky(int size);

} // namespace bake
