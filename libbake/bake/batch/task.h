// The tasks of a manifest: one command each.
#pragma once
#include "bake/verdict/plan/manifest.h"
#include <cstdint>
#include <string>
#include <vector>

namespace bake {

struct BatchTask {
    std::string name;               ///< unique
    std::vector<std::string> words; ///< behind `bake`
    std::vector<std::string>
        inputs; ///< files that the manifest names; what they name in turn is not known before the run
    std::vector<std::string> outputs; ///< as the manifest names them: may have %s or <UDIM> in them
    std::vector<std::uint32_t> needs; ///< tasks that write inputs of this one, ascending
    bool alone = false;               ///< runs while no other task does: it limits the memory of the process
};

/// The tasks of all bakes, each behind those that it needs, else in the order of the manifest. A bake with * or ? in one of
/// its inputs is a task for each file: of those that are there, and of the outputs of bakes before it. A bake with `tiles`
/// is a task for each. In all texts of such a bake, {stem} stands for the file's stem_of(), and {tile} and <UDIM> for the
/// tile. Paths are relative to the working directory, which is the folder of the manifest. A task needs those whose
/// outputs are its inputs, and all tasks of the bakes that its `after` names. `file`: for messages. Throws
/// Error{Refusal::unreadable}, "<file>: <what is wrong>; <how to mend it>", for two tasks of one name or one output, for
/// tasks that need each other in a circle, for a pattern without files, and for {} without a meaning.
std::vector<BatchTask> batch_tasks(const Manifest& manifest, const std::string& file);

/// The tasks whose names match a pattern (matches()), and those that they need. Throws Error{Refusal::usage} if none does.
std::vector<BatchTask> with_needs(std::vector<BatchTask> tasks, const std::string& pattern, const std::string& file);

} // namespace bake
