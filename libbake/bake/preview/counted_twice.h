// Whether a map shows relief that its mesh has already, so that every slope counts twice.
#pragma once
#include "bake/preview/material.h"

namespace bake {

/// How much the normals that the relief of a material adds vary over a shape as the shape's own normals do.
struct CommonRelief {
    double correlation = 0; ///< -1 to 1, of the differences between neighbouring corners; 0 if one of the two is flat
    double share = 0; ///< how large the shape's differences are for those of the relief, by least squares with weights
};

/// About 20 000 triangles are looked at. The shape must have tangents if the material has a normal map.
CommonRelief common_relief(const Material& material, const Shape& shape) noexcept;

/// The shape was displaced by a relief like that of the material.
bool counted_twice(const CommonRelief& common) noexcept;

} // namespace bake
