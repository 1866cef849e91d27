// Crosses whose caps or arms are not in the usual place, folded as a net of the cube.
//
//   hcross: four cells in a row; one cell above the row (py) and one below it (ny), usually both in the second column.
//           The cell under py is pz; px, nz and nx follow to its right, cyclically
//   vcross: four cells in a column; one cell at its left (nx) and one at its right (px), usually both in the second row.
//           The cell to the right of nx is pz; ny, nz and py follow downwards, cyclically
#pragma once
#include "bake/environment/sky/layout.h"

namespace bake {

/// Positions, 0 to 3, along the row or column of four cells.
struct CrossShape {
    int first = 1;  ///< of py above the row, of nx at the left of the column
    int second = 1; ///< of ny below the row, of px at the right of the column
    bool operator==(const CrossShape&) const = default;
};

/// The shape of a cross by its filled cells. A cell whose inside is of one value counts as empty. The usual places are
/// taken unless they are empty and exactly one other cell beside the row or column is filled. `picture` has the size of
/// the layout, hcross or vcross.
CrossShape find_cross(const Image<float>& picture, CubeLayout layout);

/// Cuts a cross of any shape. Throws as cut_faces.
Cube cut_cross(const Image<float>& picture, CubeLayout layout, const CrossShape& shape, const std::string& file);

} // namespace bake
