// Options of bake cubemap.
#pragma once
#include "bake/environment/engine/engine_files.h"
#include "bake/environment/file/environment_io.h"
#include "bake/environment/file/write_environment.h"
#include "bake/environment/filter/irradiance.h"
#include "bake/environment/filter/prefilter.h"
#include "verb.h"
#include <optional>
#include <string>
#include <vector>

namespace bake {

enum class Specular { none, ggx, phong };

struct EngineArgs {
    std::optional<Consumer> consumer;
    std::optional<TexelFormat> texels;
    bool levels_as_files = false;

    EngineOptions options(int size, bool whole_set) const {
        return {consumer.value_or(Consumer::three), size, texels, levels_as_files, whole_set};
    }
};

struct CubemapArgs {
    std::vector<std::string> inputs;
    std::string capture, at; ///< a scene and the point to look from
    ReadEnvironmentOptions reading;
    ResampleOptions resampling;
    double yaw = 0, pitch = 0, roll = 0;
    bool mips = false, linear = false, srgb = false;
    std::string irradiance, roughness;
    Specular specular = Specular::none;
    EnvironmentTarget target;
    EngineArgs engine;
    std::string sh_file; ///< text with coefficients of spherical harmonics

    // Set by check_cubemap_options.
    Vec3f position{0};
    std::optional<IrradianceOptions> wanted_irradiance;
    std::optional<PrefilterOptions> wanted_specular;
};

void add_cubemap_options(CLI::App& sub, CubemapArgs& args);
/// Reads the values that are lists and completes the options that depend on each other. Throws Error{Refusal::usage}.
void check_cubemap_options(CubemapArgs& args);

} // namespace bake
