// A list of bakes as TOML: the commands that make the files which a scene needs. docs/manifest.md describes the format.
#pragma once
#include "bake/verdict/plan/manifest_bake.h"
#include "bake/verdict/plan/plan.h"
#include <string>
#include <vector>

namespace bake {

struct Manifest {
    std::vector<Bake> bakes; ///< each behind those that it needs
    std::vector<std::string> notes;
};

/// The bakes of the models and of the sky that a plan chose, and of the maps that it decided for models that the scene names.
/// `out`: the file that the manifest will be; outputs are beside it. What no command bakes is told in a note. Reads meshes where an
/// amplitude is a part of their size. Throws the errors of the readers.
Manifest plan_manifest(const SceneEntries& entries, const ScenePlan& plan, const std::string& out);
std::string to_toml(const Manifest& manifest);
/// The same from text. `file`: its name, for messages. Throws Error{Refusal::unreadable}, "<file>:<line>: <what is wrong>; <how
/// to mend it>".
Manifest parse_manifest(const std::string& text, const std::string& file);
/// The words behind `bake`.
std::vector<std::string> command_of(const Bake& bake);

} // namespace bake
