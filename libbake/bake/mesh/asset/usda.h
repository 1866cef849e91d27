// Parts of a USD layer.
#pragma once
#include "bake/mesh/asset/looks.h"

namespace bake {

/// A text between quotation marks, on one line.
std::string quoted(const std::string& text);
/// The prim of the material.
std::string look_path(const Look& look);
/// The prim of the material with its shaders, of UsdPreviewSurface.
std::string usd_material(const Look& look);

} // namespace bake
