#include "bake/base/job.h"
#include "bake/base/helped_job.h"
#include <unistd.h>
#include <utility>

namespace bake {
namespace {

thread_local Job* current = nullptr;
thread_local std::shared_ptr<const HelpedJob> helped;

} // namespace

Job& process_job() noexcept {
    static Job job;
    return job;
}

Job& current_job() noexcept {
    if (current) return *current;
    Job* const job = helped ? helped->job.load(std::memory_order_acquire) : nullptr;
    return job ? *job : process_job();
}

Job* work_for(Job* job) noexcept { return std::exchange(current, job); }

void help(std::shared_ptr<const HelpedJob> job) noexcept { helped = std::move(job); }

bool draws_on_terminal() noexcept { return current_job().draws && isatty(STDERR_FILENO); }

} // namespace bake
