// Texels for a program that interpolates between them.
//
// Between samples of a smooth function f, h apart, the straight line lies h^2 f'' / 12 above it on average: above it where it
// is convex, and below it around a maximum. Samples that are changed by as much the other way, along both axes, remove this
// mean, and the root mean square of what is left is sqrt(1/120 - 1/144) h^2 f'' instead of sqrt(1/120) h^2 f'': 2.4 times
// smaller. With the second difference for h^2 f'' the weights along an axis are [-1 14 -1] / 12, a quasi-interpolation in the
// sense of Condat, Blu and Unser, Beyond Interpolation: Optimal Reconstruction by Quasi-Interpolation, ICIP 2005.
#pragma once
#include "bake/environment/sky/cube.h"

namespace bake {

/// The texels between which bilinear interpolation across edges, as lookup() and graphics cards do it, is nearest to the
/// function whose values at the centres of the texels are given. No value that is positive or 0 falls below its half: around a
/// light smaller than a texel the correction would make it negative. Values: finite, any number of channels.
Cube interpolated_best(const Cube& samples);

} // namespace bake
