// Runs the tasks of a manifest on all cores, those alone that would change something.
#pragma once
#include "bake/batch/ledger.h"
#include "bake/batch/task.h"
#include <atomic>
#include <functional>

namespace bake {

/// What running one task gave.
struct TaskRun {
    int code = 0;
    std::string message;            ///< why it failed
    std::vector<std::string> notes; ///< what it told besides
    std::vector<ReadFile> read;
    std::vector<std::string> written;
};

struct TaskReport {
    enum class Result {
        unchanged,   ///< not run: what it would write is there
        done,        ///< run
        failed,      ///< run, with a code that is not 0
        skipped,     ///< not run: a task that it needs failed, or another one did and `keep_going` is false
        interrupted, ///< not run, or stopped by Ctrl-C
    };
    Result result = Result::interrupted;
    std::string why; ///< why it was run, or not
    std::string message;
    std::vector<std::string> notes; ///< what the run told besides
    int code = 0;
    double seconds = 0;
};

struct BatchOptions {
    int threads = 1;
    bool force = false;               ///< run all tasks
    bool keep_going = true;           ///< after a failure run all tasks that do not need the one that failed
    double seconds_between_calls = 5; ///< of `every`, at least
};

/// For a line that is shown meanwhile. From any thread.
struct BatchProgress {
    /// Of the tasks that are run; `total` is not final before all are.
    std::atomic<std::size_t> total{0}, done{0}, failed{0};
};

/// "123 of 500, 2 failed, 14 s left", from the seconds since the beginning: tasks that are left take as long as those before.
std::string progress_line(const BatchProgress& progress, double elapsed);

/// Calls run(task, threads) for each task that the ledger has a reason for, as soon as those that it needs are done, and
/// records it. Several tasks at a time, each with one thread, as long as there are enough; the last ones share all threads;
/// a task that runs `alone` has them all. The longest task first, by what the ledger knows. A task has failed if its run
/// throws, or what the ledger does for it; the others go on. Returns a report for each task. `every` is called now and
/// then from one of the threads while no other calls it; what it throws is dropped.
std::vector<TaskReport> run_batch(const std::vector<BatchTask>& tasks, Ledger& ledger, const BatchOptions& options,
                                  const std::function<TaskRun(const BatchTask&, int threads)>& run,
                                  BatchProgress& progress, const std::function<void()>& every = {});

/// What run_batch() would do, without running anything: `result` is `unchanged`, or `done` with a reason; a task whose needs
/// are run has the reason "may change: NAME is run".
std::vector<TaskReport> plan_batch(const std::vector<BatchTask>& tasks, Ledger& ledger, const BatchOptions& options);

/// 0, or the code of the first failure in the order of the tasks, or 130 after Ctrl-C.
int code_of(const std::vector<TaskReport>& reports);

} // namespace bake
