// The lat-long picture for programs that filter a sky themselves.
#pragma once
#include "bake/environment/engine/engine_files.h"
#include "bake/environment/resample/resample.h"

namespace bake {

/// Writes .exr (half floats, or floats where half floats do not suffice) or .hdr. `size`: its width; 0: as fine as the sky. The
/// sky ahead is in the middle. Throws as write_environment().
EngineFile write_engine_picture(const Environment& sky, int size, const std::string& path,
                                const ResampleOptions& resampling = {}, Progress* progress = nullptr);

} // namespace bake
