// One task of bake batch.
#pragma once
#include "bake/batch/schedule.h"

namespace bake {

/// Makes the folders of the outputs, and clears them of what killed runs left. What fails here is refused by the commands.
void prepare_folders(const std::vector<BatchTask>& tasks);

/// Runs the command of a task in this process.
TaskRun run_task(const BatchTask& task, int threads);

} // namespace bake
