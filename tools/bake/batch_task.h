// One task of bake batch.
#pragma once
#include "bake/base/shared_loads.h"
#include "bake/batch/schedule.h"

namespace bake {

/// Makes the folders of the outputs, and clears them of what killed runs left. What fails here is refused by the commands.
void prepare_folders(const std::vector<BatchTask>& tasks);

/// The inputs that more than one task names, whose decoded values are worth keeping (SharedLoads).
std::unordered_set<std::string> shared_inputs(const std::vector<BatchTask>& tasks);
/// The memory that these may take: an eighth of what the process may have, and no more than 1 GiB.
std::size_t shared_bytes();

/// Runs the command of a task in this process.
TaskRun run_task(const BatchTask& task, int threads);

} // namespace bake
