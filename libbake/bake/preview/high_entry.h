// A high-poly mesh as a mesh of a scene names it, and how much of its detail is shown.
#pragma once
#include "bake/preview/relief_method.h"
#include <string>

namespace bake {

struct HighEntry {
    std::string file; ///< empty: there is none
    /// plain: the low-poly mesh without the detail; normal: with a normal map that is baked from the high-poly mesh; high: that mesh.
    Shade shade = Shade::plain;
    int size = 1024;         ///< edge of the normal map in texels
    bool normal_bc5 = false; ///< it is shown as BC5 blocks store it
};

} // namespace bake
