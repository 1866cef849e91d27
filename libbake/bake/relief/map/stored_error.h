// The error of a normal map as it is stored.
#pragma once
#include "bake/picture/image.h"

namespace bake {

/// Angles between normals as they are read back and as they were, over all texels, degrees.
struct StoredError {
    double mean_deg = 0, p95_deg = 0, max_deg = 0, rms_deg = 0;
};

/// `stored`: three channels (n + 1) / 2 as a file gives them, normalised here. `normals`: unit vectors of the same size.
StoredError stored_error(const Image<float>& stored, const Image<float>& normals);

} // namespace bake
