// What the parts of one command share. Several commands can run at the same time in one process, each as a job of its own.
#pragma once
#include <atomic>
#include <functional>
#include <string>

namespace bake {

struct InputFiles;
class MemoryCap;
class OutputSet;
struct RunDescription;

struct Job {
    /// What thread_count() gives; 0: as many threads as the process may use.
    int threads = 0;
    /// Whether progress may be drawn on stderr where that is a terminal.
    bool draws = true;
    /// Take what is printed on stdout and on stderr; empty: these streams. From any thread of the job.
    std::function<void(const std::string&)> print, tell;
    /// Is told every line of stderr too, as it is printed.
    std::function<void(const std::string&)> hears;

    // Of RunRecord, InputRecord, OutputSet and MemoryCap, and of accept_interrupt().
    std::atomic<const RunDescription*> run = nullptr;
    std::atomic<InputFiles*> inputs = nullptr;
    std::atomic<OutputSet*> outputs = nullptr;
    std::atomic<const MemoryCap*> caps = nullptr;
    std::atomic<bool> stop_accepted = false;
};

/// The job that the calling thread works for: that of run_job() (base/run_job.h), or else that of the process.
Job& current_job() noexcept;
/// The job of the process: its caps on memory hold for all jobs.
Job& process_job() noexcept;
/// Makes the calling thread work for a job, null: for that of the process. Returns the one before, in the same way.
Job* work_for(Job* job) noexcept;

/// Whether stderr is a terminal that the current job may draw on.
bool draws_on_terminal() noexcept;

} // namespace bake
