// The tasks of a manifest for other programs that run them.
#pragma once
#include "bake/base/shell_word.h"
#include "bake/batch/task.h"
#include <string>
#include <vector>

namespace bake {

enum class EmitFormat {
    ninja,    ///< a build.ninja for the folder of the manifest: what changed, on one machine
    slurm,    ///< a shell script that submits an array of jobs for each level
    commands, ///< lines of a shell, each behind those that it needs
    openjd,   ///< a job template of Open Job Description 2023-09, JSON
};

struct EmitOptions {
    int chunk = 1;      ///< tasks that one job of a farm runs one after the other
    std::string folder; ///< of the manifest, absolute
    std::string name;   ///< of the manifest, without its folder
};

/// What the format has for all tasks. Slurm and OpenJD wait for all tasks of a level before they start the next one; a
/// level is 0 for tasks without needs, else one more than the highest of the needs. A task that Slurm runs a second time
/// after its machine failed leaves out the commands of its chunk that were done.
std::string emitted(const std::vector<BatchTask>& tasks, EmitFormat format, const EmitOptions& options);

} // namespace bake
