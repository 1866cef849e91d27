// bake cubemap --for: the files that an engine loads.
#pragma once
#include "cubemap_options.h"
#include "inputs/output_folder.h"

namespace bake {

void add_engine_options(CLI::App& sub, CubemapArgs& args);
/// Throws Error{Refusal::usage} for options that --for decides itself, and for those that need it.
void check_engine_options(const CubemapArgs& args);

/// Where the files of a run go: one file, or a folder, which is made.
class EngineOutput {
public:
    explicit EngineOutput(const CubemapArgs& args);
    /// Refuses what cannot be written, before the work.
    void check() const;
    /// Ending of the cube maps.
    std::string ending() const;
    std::string path(const std::string& name) const;
    bool is_folder() const noexcept { return bool(folder_); }

private:
    const CubemapArgs& args_;
    OutputFolder folder_;
};

/// Filters and writes. `cube`: gives the sky as six faces with texel centres inside. Returns what is printed.
std::string write_for_engine(const CubemapArgs& args, const EngineOutput& output, const Environment& sky,
                             Progress& progress, nlohmann::json& json);

/// {l m} as lists of channels.
nlohmann::json sh_json(const ShCoefficients& series);
/// One line per coefficient.
std::string sh_lines(const ShCoefficients& series);

} // namespace bake
