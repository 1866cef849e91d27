// Runs work as a job, on threads that work for no other job meanwhile.
#pragma once
#include "bake/base/job.h"

namespace bake {

/// Calls work() as a part of `job` with at most job.threads threads. A thread that waits for the others takes no work of
/// another job. Sets job.threads if it is 0. Rethrows what work() throws.
void run_job(Job& job, const std::function<void()>& work);

} // namespace bake
