// The job that a thread of a pool helps with.
#pragma once
#include <atomic>
#include <memory>

namespace bake {

struct Job;

/// Outlives the job: a thread of the pool may leave it late, and nothing tells the thread when it has ended.
struct HelpedJob {
    std::atomic<Job*> job = nullptr; ///< null: it has ended
};

/// Makes the calling thread work for a job whenever work_for() names none; null: for that of the process.
void help(std::shared_ptr<const HelpedJob> job) noexcept;

} // namespace bake
