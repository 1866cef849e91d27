// What the way in which a scene shows a height costs in accuracy on a shape.
#pragma once
#include "bake/preview/relief_method.h"

namespace bake {

/// describe() of the method's error (method_error.h) over points of all triangles: of constant_scale, blinn, and of tables
/// of slopes, which are looked up as blinn does. Empty if it does not show, and for other methods. The shape needs its
/// derivatives.
std::string relief_doubt(const Shape& shape, const HeightTexture& height, const ReliefOptions& options);

} // namespace bake
