// The files of an environment that an engine loads, with the error of what is stored in them.
#pragma once
#include "bake/environment/engine/encoding_error.h"
#include "bake/environment/engine/engine_levels.h"
#include <cstdint>
#include <functional>

namespace bake {

struct EngineFile {
    std::string path;
    std::string what; ///< environment, skybox, irradiance, dfg, sh
    int edge = 0, levels = 0;
    TexelFormat texels = TexelFormat::rgba16f;
    std::int64_t bytes = 0;
    EncodingError error;
};

/// rgb9e5, half, bc6h.
const char* name(TexelFormat texels) noexcept;

/// Whether the ending is that of a lat-long picture (.hdr, .exr), not of levels.
bool is_latlong_file(const std::string& path);
/// Throws Error{Refusal::usage} for an ending that no file for the consumer can have, or texels that its container cannot
/// hold: .dds and .ktx2 hold all three, .ktx, which is Filament's, half floats.
void check_engine_file(const std::string& path, const EngineOptions& options);

/// Writes one file, or the whole set. `path(name)` gives the path of a file: "environment", "skybox", "irradiance" and
/// "dfg", each with its ending, and "sh.txt"; if the levels are files, "environment_0" and so on. Each file is decoded again from
/// its bytes (KTX of version 1 from its texels) before it is committed. Throws as OutputFile.
std::vector<EngineFile> write_engine_files(const EngineLevels& made, const EngineOptions& options,
                                           const std::string& ending,
                                           const std::function<std::string(const std::string&)>& path);

} // namespace bake
