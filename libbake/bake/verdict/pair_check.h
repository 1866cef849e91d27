// A height texture and a normal map said to be of the same relief: do they agree, and by which conventions.
#pragma once
#include "bake/picture/image.h"

namespace bake {

/// Slopes are compared in u right, v up, per texel of the compared size: ours the central difference of the height,
/// the author's -n_x / n_z and -n_y / n_z, both smoothed by a box of 5 x 5 texels, borders repeating.
struct PairCheck {
    int width = 0, height = 0;       ///< compared size: the smaller of both, per axis
    double corr_x = 0, corr_y = 0;   ///< correlation of author's and our slope along u and v, normals taken as OpenGL
    double scale_x = 0, scale_y = 0; ///< author's slope per unit of height per texel, least squares; signed
    double scale = 0;                ///< both together, signs aside
    bool inverted = false;           ///< the normal map is that of the negative height
    bool directx = false;            ///< green down
    bool flat = false;               ///< height or normals have no slope at all: nothing to compare
    double normal_length = 0;        ///< mean |n| before normalising
    double not_unit = 0;             ///< share of texels more than 2 % off unit length
    double inward = 0;               ///< share of texels with n_z <= 0, which have no slope; left out by a slope of 20
};

/// Both correlations at least this: the same relief.
inline constexpr double pair_agrees = 0.8;
/// Below this the conventions are guessed from noise.
inline constexpr double pair_tells = 0.3;

/// `height` has one channel; `normals` three or more, the first three being n = 2 rgb - 1. The larger one is
/// box-filtered to the size of the smaller first. Values must be finite.
PairCheck check_pair(const Image<float>& height, const Image<float>& normals);

} // namespace bake
