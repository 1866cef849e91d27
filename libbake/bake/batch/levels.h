// Tasks in levels, for programs that run a list and then wait. Internal to this room.
#pragma once
#include "bake/batch/task.h"
#include <vector>

namespace bake {

/// The numbers of the tasks of each level, ascending; none is empty.
std::vector<std::vector<std::size_t>> levels_of(const std::vector<BatchTask>& tasks);

/// "bake normal-map 'a b.png' ...", as a shell takes it.
std::string command_line_of(const BatchTask& task);

/// "mkdir -p ..." of the folders of all outputs, a line; empty if there are none.
std::string folder_line_of(const std::vector<BatchTask>& tasks);

/// Emitters of their formats, see emit.h.
struct EmitOptions;
std::string emitted_ninja(const std::vector<BatchTask>& tasks);
std::string emitted_slurm(const std::vector<BatchTask>& tasks, const EmitOptions& options);
std::string emitted_openjd(const std::vector<BatchTask>& tasks, const EmitOptions& options);

} // namespace bake
