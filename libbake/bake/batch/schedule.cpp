#include "bake/batch/schedule.h"
#include "bake/base/error.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <set>
#include <thread>

namespace bake {
namespace {

using Result = TaskReport::Result;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// What a run gave that ended with the exception that is being handled.
TaskRun failure() noexcept {
    TaskRun run{int(Refusal::unsuitable), {}, {}, {}};
    try {
        try {
            throw;
        } catch (const Error& error) {
            run.code = int(error.refusal);
            run.message = error.what();
        } catch (const std::bad_alloc&) {
            run.message = "out of memory";
        } catch (const std::exception& error) {
            run.message = error.what();
        }
    } catch (...) { // no memory for the message: the code alone tells of the failure
    }
    return run;
}

class Schedule {
public:
    Schedule(const std::vector<BatchTask>& tasks, Ledger& ledger, const BatchOptions& options,
             const std::function<TaskRun(const BatchTask&, int)>& run, BatchProgress& progress,
             const std::function<void()>& every)
        : tasks_(tasks), ledger_(ledger), options_(options), run_(run), progress_(progress), every_(every),
          reports_(tasks.size()), open_(tasks.size()), users_(tasks.size()), last_call_(Clock::now()) {
        for (std::uint32_t i = 0; i < tasks.size(); ++i) {
            open_[i] = tasks[i].needs.size();
            for (const std::uint32_t need : tasks[i].needs) users_[need].push_back(i);
        }
        unsettled_.reserve(tasks.size());
        for (std::uint32_t i = 0; i < tasks.size(); ++i)
            if (tasks[i].needs.empty()) settle(i);
    }

    std::vector<TaskReport> result() {
        const std::size_t count = std::min<std::size_t>(std::size_t(options_.threads), ready_.size() + waiting());
        std::vector<std::thread> workers;
        workers.reserve(count);
        try {
            while (workers.size() + 1 < count) workers.emplace_back([this] { work(); });
        } catch (const std::exception&) { // a limit on threads or on memory: those that started do the work
        }
        work();
        for (std::thread& worker : workers) worker.join();
        skip_users();
        return std::move(reports_);
    }

private:
    /// Tasks that may become ready.
    std::size_t waiting() const {
        return std::size_t(std::count_if(open_.begin(), open_.end(), [](std::size_t needs) { return needs > 0; }));
    }

    /// All that task `i` needs is done: it is unchanged, and with it perhaps those that need it, or it is to run.
    void settle(std::uint32_t i) noexcept {
        unsettled_.push_back(i);
        while (!unsettled_.empty()) {
            const std::uint32_t task = unsettled_.back();
            unsettled_.pop_back();
            TaskReport& report = reports_[task];
            try {
                report.why = options_.force ? "forced" : ledger_.why(tasks_[task]);
                if (!report.why.empty()) {
                    ready_.insert({-ledger_.seconds(tasks_[task]).value_or(0), task});
                    ++progress_.total;
                    continue;
                }
            } catch (...) {
                ++progress_.total;
                finish(task, failure(), 0);
                continue;
            }
            report.result = Result::unchanged;
            for (const std::uint32_t user : users_[task])
                if (--open_[user] == 0) unsettled_.push_back(user);
        }
    }

    /// Tasks that were not reached, as one that they need failed. Needs stand before those that need them.
    void skip_users() {
        for (std::size_t i = 0; i < tasks_.size(); ++i)
            for (const std::uint32_t need : tasks_[i].needs) {
                const Result result = reports_[need].result;
                if (result != Result::failed && result != Result::skipped) continue;
                reports_[i].result = Result::skipped;
                reports_[i].why = "needs " + tasks_[need].name;
                break;
            }
    }

    bool stopped() const { return interrupted() || (!options_.keep_going && progress_.failed > 0); }

    /// Waits for a task; nothing when there will be none.
    std::optional<std::uint32_t> next(std::unique_lock<std::mutex>& lock) {
        for (;;) {
            if (stopped() || (ready_.empty() && running_ == 0)) return {};
            if (!ready_.empty() && !alone_) {
                const std::uint32_t task = ready_.begin()->second;
                if (!tasks_[task].alone || running_ == 0) return task;
            }
            changed_.wait_for(lock, std::chrono::milliseconds(100)); // Ctrl-C wakes nobody
        }
    }

    void work() {
        std::unique_lock lock(mutex_);
        while (const auto task = next(lock)) {
            ready_.erase(ready_.begin());
            const std::size_t tasks_left = ready_.size() + running_ + 1;
            const int threads =
                tasks_[*task].alone
                    ? options_.threads
                    : std::max(1, options_.threads /
                                      int(std::min<std::size_t>(tasks_left, std::size_t(options_.threads))));
            ++running_;
            alone_ = tasks_[*task].alone;
            lock.unlock();
            const auto begin = Clock::now();
            TaskRun done = run(*task, threads, begin);
            const double seconds = seconds_since(begin);
            lock.lock();
            --running_;
            alone_ = false;
            finish(*task, std::move(done), seconds);
            call_every();
            changed_.notify_all();
        }
        changed_.notify_all();
    }

    /// Runs and records a task. One that cannot be recorded has failed, as it would run again the next time.
    TaskRun run(std::uint32_t task, int threads, Clock::time_point begin) noexcept {
        TaskRun done;
        try {
            done = run_(tasks_[task], threads);
            if (done.code == 0) ledger_.record(tasks_[task], done.read, done.written, seconds_since(begin));
        } catch (...) {
            done = failure();
        }
        if (done.code != 0) ledger_.forget(tasks_[task]);
        return done;
    }

    void finish(std::uint32_t i, TaskRun done, double seconds) noexcept {
        TaskReport& report = reports_[i];
        report.code = done.code, report.message = std::move(done.message);
        report.notes = std::move(done.notes), report.seconds = seconds;
        const bool stopped = done.code == int(Refusal::interrupted);
        report.result = done.code == 0 ? Result::done : stopped ? Result::interrupted : Result::failed;
        ++progress_.done;
        if (report.result == Result::failed) ++progress_.failed;
        if (report.result == Result::done)
            for (const std::uint32_t user : users_[i])
                if (--open_[user] == 0) settle(user);
    }

    void call_every() noexcept {
        if (!every_ || seconds_since(last_call_) < options_.seconds_between_calls) return;
        try {
            every_();
        } catch (const std::exception&) { // the caller does the same at the end, and tells why it cannot be done
        }
        last_call_ = Clock::now();
    }

    const std::vector<BatchTask>& tasks_;
    Ledger& ledger_;
    const BatchOptions& options_;
    const std::function<TaskRun(const BatchTask&, int)>& run_;
    BatchProgress& progress_;
    const std::function<void()>& every_;
    std::vector<TaskReport> reports_;
    std::vector<std::size_t> open_; ///< tasks that each one still waits for
    std::vector<std::vector<std::uint32_t>> users_;
    std::vector<std::uint32_t> unsettled_;             ///< by settle()
    std::set<std::pair<double, std::uint32_t>> ready_; ///< the longest first
    std::mutex mutex_;
    std::condition_variable changed_;
    std::size_t running_ = 0;
    bool alone_ = false;
    Clock::time_point last_call_;
};

} // namespace

std::vector<TaskReport> run_batch(const std::vector<BatchTask>& tasks, Ledger& ledger, const BatchOptions& options,
                                  const std::function<TaskRun(const BatchTask&, int threads)>& run,
                                  BatchProgress& progress, const std::function<void()>& every) {
    std::vector<TaskReport> reports = Schedule(tasks, ledger, options, run, progress, every).result();
    if (!interrupted() && !options.keep_going && progress.failed > 0)
        for (TaskReport& report : reports)
            if (report.result == Result::interrupted)
                report.result = Result::skipped, report.why = "another task failed";
    return reports;
}

std::vector<TaskReport> plan_batch(const std::vector<BatchTask>& tasks, Ledger& ledger, const BatchOptions& options) {
    std::vector<TaskReport> reports(tasks.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        TaskReport& report = reports[i];
        report.why = options.force ? "forced" : ledger.why(tasks[i]);
        for (const std::uint32_t need : tasks[i].needs)
            if (report.why.empty() && reports[need].result == Result::done)
                report.why = "may change: " + tasks[need].name + " is run";
        report.result = report.why.empty() ? Result::unchanged : Result::done;
        report.seconds = ledger.seconds(tasks[i]).value_or(0);
    }
    return reports;
}

int code_of(const std::vector<TaskReport>& reports) {
    for (const TaskReport& report : reports)
        if (report.result == Result::interrupted) return int(Refusal::interrupted);
    for (const TaskReport& report : reports)
        if (report.result == Result::failed) return report.code;
    return 0;
}

std::string progress_line(const BatchProgress& progress, double elapsed) {
    const std::size_t done = progress.done, total = progress.total, failed = progress.failed;
    std::string line = std::to_string(done) + " of " + std::to_string(total);
    if (failed > 0) line += ", " + std::to_string(failed) + " failed";
    if (done > 0 && done < total) line += format(", %.0f s left", elapsed / double(done) * double(total - done));
    return line;
}

} // namespace bake
