// A list of bakes as TOML: the commands that make the files which a scene needs. docs/manifest.md describes the format.
#pragma once
#include "bake/verdict/plan/plan.h"
#include <string>
#include <utility>
#include <vector>

namespace bake {

/// One command. Paths are relative to the folder of the manifest.
struct Bake {
    std::string name; ///< within the manifest
    std::string verb;
    std::vector<std::string> files; ///< arguments without an option
    using Values = std::vector<std::pair<std::string, std::string>>;
    Values inputs, outputs;         ///< option without dashes and file
    Values options;                 ///< option without dashes and value; an empty value is a flag
    std::vector<std::string> after; ///< names of bakes whose outputs this one reads
    std::vector<std::string> objects;
    std::string use; ///< key of a material, a mesh or the sky that takes the first output; empty: an intermediate file
};

struct Manifest {
    std::vector<Bake> bakes; ///< each behind those that it needs
    std::vector<std::string> notes;
};

/// The bakes of the models and of the sky that a plan chose, and of the maps that it decided for other models. `out`: the file that the manifest will be; outputs are beside it. What no command
/// bakes is told in a note. Reads meshes where an amplitude is a part of their size. Throws the errors of the readers.
Manifest plan_manifest(const SceneEntries& entries, const ScenePlan& plan, const std::string& out);
std::string to_toml(const Manifest& manifest);
/// The same from text. `file`: its name, for messages. Throws Error{Refusal::unreadable}, "<file>:<line>: <what is wrong>; <how
/// to mend it>".
Manifest parse_manifest(const std::string& text, const std::string& file);
/// Characters of paths that the format keeps for later.
inline constexpr const char* reserved_in_paths = "*?{}";
/// The words behind `bake`.
std::vector<std::string> command_of(const Bake& bake);

} // namespace bake
