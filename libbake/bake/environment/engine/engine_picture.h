// The lat-long picture for programs that filter a sky themselves, or show it as it is.
#pragma once
#include "bake/environment/engine/engine_files.h"
#include "bake/environment/resample/resample.h"

namespace bake {

/// Writes .exr (half floats, or floats where half floats do not suffice) or .hdr for a consumer that takes a lat-long.
/// `options.size`: its width; 0: as fine as the sky. After the turn of `resampling` the sky is turned to what the consumer has
/// in the middle of its pictures (LatlongRule). Throws as write_environment().
EngineFile write_engine_picture(const Environment& sky, const EngineOptions& options, const std::string& path,
                                ResampleOptions resampling = {}, Progress* progress = nullptr);

} // namespace bake
