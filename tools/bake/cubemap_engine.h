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

struct ReadSky {
    const Environment& sky;
    const EnvironmentReport& report;
};

/// Filters, writes and prints the result. Returns the exit code.
int run_for_engine(const CubemapArgs& args, const CommonArgs& common, const EngineOutput& output, const ReadSky& read,
                   Progress& progress, Stopwatch& watch);

nlohmann::json file_json(const EngineFile& file);
std::string file_line(const EngineFile& file);
/// What --for did to a lat-long: ", turned by 90 degrees: ...".
std::string latlong_text(const ConsumerEntry& consumer);
/// {l m} as lists of channels.
nlohmann::json sh_json(const ShCoefficients& series);
/// One line per coefficient.
std::string sh_lines(const ShCoefficients& series);

} // namespace bake
