#include "bake/base/run_job.h"
#include "bake/base/helped_job.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>

namespace bake {
namespace {

/// Tells the threads that come to help which job they work for.
class Helpers : public tbb::task_scheduler_observer {
public:
    Helpers(tbb::task_arena& arena, Job& job) : tbb::task_scheduler_observer(arena) {
        helped_->job = &job;
        observe(true);
    }
    ~Helpers() override {
        observe(false); // after which no thread that is still there is told that it leaves
        helped_->job = nullptr;
    }
    void on_scheduler_entry(bool is_worker) override {
        if (is_worker) help(helped_);
    }
    void on_scheduler_exit(bool is_worker) override {
        if (is_worker) help(nullptr);
    }

private:
    const std::shared_ptr<HelpedJob> helped_ = std::make_shared<HelpedJob>();
};

struct Turn {
    Job* const before;
    explicit Turn(Job& job) : before(work_for(&job)) {}
    ~Turn() { work_for(before); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
};

} // namespace

void run_job(Job& job, const std::function<void()>& work) {
    if (job.threads == 0) job.threads = thread_count();
    const Turn turn(job);
    // TBB prints a warning when an arena is to have more threads than the process.
    const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    tbb::task_arena arena(std::min(job.threads, int(most)));
    const Helpers helpers(arena, job);
    arena.execute(work);
}

} // namespace bake
