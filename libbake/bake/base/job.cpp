#include "bake/base/job.h"
#include <unistd.h>
#include <utility>

namespace bake {
namespace {

thread_local Job* current = nullptr;

} // namespace

Job& process_job() noexcept {
    static Job job;
    return job;
}

Job& current_job() noexcept { return current ? *current : process_job(); }

Job* work_for(Job* job) noexcept { return std::exchange(current, job); }

bool draws_on_terminal() noexcept { return current_job().draws && isatty(STDERR_FILENO); }

} // namespace bake
