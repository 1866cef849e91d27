// The file of the verb displace.
#pragma once
#include "displace_options.h"

namespace bake {

/// Writes the mesh, with the fold margin and the tangents that are asked for. Of a glTF file all else is kept, and if it
/// `has_tangents` they are made to fit. Adds notes on what is not kept. Returns the bytes of all files.
std::int64_t write_displaced(const DisplaceArgs& args, bool has_tangents, Displaced& displaced, const Facts& facts,
                             std::vector<std::string>& notes);

/// What writing and testing the result take.
std::vector<LaterStep> later_steps(const DisplaceArgs& args, const BaseSurface& base);

} // namespace bake
