// Comparison of a height texture with a normal map: whether they show the same relief, and with which conventions.
#pragma once
#include "bake/picture/image.h"

namespace bake {

/// Compares two slopes per texel, with u right and v up: the central difference of the height, and -n_x / n_z, -n_y / n_z of
/// the normals. Both are smoothed by a box of 5 x 5 texels with repeated borders.
struct PairCheck {
    int width = 0, height = 0;       ///< compared size: the smaller size per axis
    double corr_x = 0, corr_y = 0;   ///< correlation of the slopes along u and v, with the normals read as OpenGL
    double scale_x = 0, scale_y = 0; ///< slope of the normals per unit of height and texel, least squares, signed
    double scale = 0;                ///< the same for both axes together, without sign
    bool inverted = false;           ///< the normal map shows the negative height
    bool directx = false;            ///< green points down
    bool flat = false;               ///< the height or the normals have no slope, so the other members are 0
    double normal_length = 0;        ///< mean |n|
    double not_unit = 0;             ///< fraction of texels more than 2 % off unit length
    double inward = 0;               ///< fraction of texels with n_z <= 0; their slope is limited to 20
};

/// The relief is the same if both correlations are at least this.
inline constexpr double pair_agrees = 0.8;
/// Below this correlation the conventions are unreliable.
inline constexpr double pair_tells = 0.3;

/// `height` has one channel. `normals` has at least three, the first three encode n = 2 rgb - 1. The larger image is
/// box-filtered to the size of the smaller one. Values must be finite.
PairCheck check_pair(const Image<float>& height, const Image<float>& normals);

} // namespace bake
