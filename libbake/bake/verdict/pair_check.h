// Comparison of a height texture with a normal map: whether they show the same relief, and with which conventions.
#pragma once
#include "bake/picture/image.h"
#include <optional>

namespace bake {

/// Compares two slopes per texel, with u right and v up: the central difference of the height, and -n_x / n_z, -n_y / n_z of
/// the normals. Both are smoothed by a box of 5 x 5 texels with repeated borders. An axis decides if its correlation is at
/// least pair_tells in magnitude: u decides whether the height is inverted, u and v together where green points. Relief
/// along one axis alone leaves questions open.
struct PairCheck {
    int width = 0, height = 0;       ///< compared size: the smaller size per axis
    double corr_x = 0, corr_y = 0;   ///< correlation of the slopes along u and v, with the normals read as OpenGL
    double corr = 0;                 ///< of both axes, weighted by the energy of their slopes, without sign
    double scale_x = 0, scale_y = 0; ///< slope of the normals per unit of height and texel, least squares, signed
    double scale = 0;                ///< the same for the axes that decide together, without sign
    bool height_decided = false, green_decided = false;
    bool inverted = false;    ///< the normal map shows the negative height; false if not decided
    bool directx = false;     ///< green points down; false if not decided
    bool flat = false;        ///< the height or the normals have no slope, so the other members are 0
    double normal_length = 0; ///< mean |n|
    double not_unit = 0;      ///< fraction of texels more than 2 % off unit length
    double inward = 0;        ///< fraction of texels with n_z <= 0; their slope is limited to 20
};

/// The relief is the same if `corr` is at least this.
inline constexpr double pair_agrees = 0.8;
/// Below this correlation the conventions are unreliable.
inline constexpr double pair_tells = 0.3;

/// `height` has one channel. `normals` has three: decoded vectors, y as stored. The larger image is box-filtered to the size
/// of the smaller one. Values must be finite.
PairCheck check_pair(const Image<float>& height, const Image<float>& normals);

/// The same of two normal maps of one size, which are decoded, with y as stored: the first one takes the place of the height.
/// So `inverted` says that the slopes along u are opposed, and `directx` that the green of the two points opposite ways.
/// `normal_length`, `not_unit` and `inward` are those of the second.
PairCheck check_normals(const Image<float>& normals, const Image<float>& other);

/// What bakes the normal map from the height: the values of options of normal_map() on a rectangle 1 wide.
struct PairRecipe {
    double amplitude = 0; ///< widths of the picture
    double extent_v = 0;  ///< height of the rectangle; 0: that of square texels
    bool invert = false, directx = false;
};
/// Nothing if the two do not show the same relief. If the relief is along v alone, `directx` and `invert` are
/// equivalent, and the recipe has `directx`.
std::optional<PairRecipe> pair_recipe(const PairCheck& check, double height_aspect);

} // namespace bake
