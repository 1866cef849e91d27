#include "bake/base/error.h"
#include "bake/batch/schedule.h"
#include "cli/command.h"
#include <mutex>
#include <thread>

using namespace bake;
using Result = TaskReport::Result;

namespace {

BatchTask task(const std::string& name, std::vector<std::uint32_t> needs = {}) {
    return {.name = name, .words = {name}, .inputs = {}, .outputs = {}, .needs = std::move(needs)};
}

struct Ran {
    std::vector<TaskReport> reports;
    std::vector<std::string> order;
};

/// Runs the tasks with a new ledger; that named "bad" fails.
Ran ran(const std::vector<BatchTask>& tasks, const BatchOptions& options) {
    const test::Folder folder;
    Ledger ledger(folder / "ledger", "1");
    BatchProgress progress;
    Ran out;
    std::mutex mutex;
    const auto run = [&](const BatchTask& one, int) {
        const std::lock_guard lock(mutex);
        out.order.push_back(one.name);
        return TaskRun{one.name == "bad" ? 4 : 0, "", {}, {}};
    };
    out.reports = run_batch(tasks, ledger, options, run, progress);
    return out;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("run_batch: after a failure all tasks run that do not need the one that failed") {
        const std::vector<BatchTask> tasks = {task("bad"), task("b", {0}), task("c"), task("d", {2}), task("e", {1})};
        for (const int threads : {1, 3}) {
            const Ran all = ran(tasks, {.threads = threads});
            CHECK(all.order.size() == 3);
            CHECK(all.reports[0].result == Result::failed);
            CHECK(all.reports[1].why == "needs bad");
            CHECK(all.reports[3].result == Result::done);
            CHECK(all.reports[4].result == Result::skipped);
            CHECK(code_of(all.reports) == 4);
        }
        const Ran first = ran(tasks, {.threads = 1, .keep_going = false});
        CHECK(first.order.size() == 1);
        CHECK(first.reports[2].result == Result::skipped);
    }

    TEST_CASE("run_batch: a task waits for what it needs, and what is unchanged does not run") {
        const test::Folder folder;
        Ledger ledger(folder / "ledger", "1");
        ledger.record(task("a"), {}, {}, 1);
        BatchProgress progress;
        std::vector<std::string> order;
        const auto run = [&](const BatchTask& one, int) {
            order.push_back(one.name);
            return TaskRun();
        };
        const std::vector<BatchTask> tasks = {task("a"), task("b", {0}), task("c", {1})};
        const auto reports = run_batch(tasks, ledger, {.threads = 1}, run, progress);
        CHECK(order == std::vector<std::string>{"b", "c"});
        CHECK(reports[0].result == Result::unchanged);
        CHECK(run_batch(tasks, ledger, {.threads = 2}, run, progress)[2].result == Result::unchanged);
    }

    TEST_CASE("run_batch: what is thrown fails the task, and the others go on") {
        const test::Folder folder;
        for (const int threads : {1, 3}) {
            Ledger ledger(folder / "ledger", "1");
            BatchProgress progress;
            std::atomic<int> calls = 0;
            const auto run = [&](const BatchTask& one, int) {
                if (one.name == "no memory") throw std::bad_alloc();
                if (one.name == "unknown") throw 1;
                return TaskRun();
            };
            const auto every = [&] {
                ++calls;
                throw std::bad_alloc();
            };
            const auto reports =
                run_batch({task("no memory"), task("unknown"), task("a", {0}), task("b"), task("c", {3})}, ledger,
                          {.threads = threads, .seconds_between_calls = 0}, run, progress, every);
            CHECK(reports[0].message == "out of memory");
            CHECK(reports[1].code == int(Refusal::unsuitable));
            CHECK(reports[2].why == "needs no memory");
            CHECK(reports[4].result == Result::done);
            CHECK(calls == 4);
            CHECK(progress.failed == 2);
        }
    }

    TEST_CASE("run_batch: many tasks have one thread each, a task that is alone has all, and no other runs meanwhile") {
        std::vector<BatchTask> tasks;
        for (int i = 0; i < 20; ++i) tasks.push_back(task(std::to_string(i)));
        tasks[7].alone = true;
        const test::Folder folder;
        Ledger ledger(folder / "ledger", "1");
        BatchProgress progress;
        std::atomic<int> running = 0, together = 0;
        std::atomic<bool> disturbed = false;
        const auto run = [&](const BatchTask& one, int threads) {
            const int now = ++running;
            together = std::max<int>(together, now);
            if (one.alone) disturbed = disturbed || now != 1 || threads != 4;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            if (one.alone) disturbed = disturbed || running != 1;
            --running;
            return TaskRun();
        };
        run_batch(tasks, ledger, {.threads = 4}, run, progress);
        CHECK(!disturbed);
        CHECK(together > 1);
        CHECK(progress_line(progress, 1) == "20 of 20");
    }

    TEST_CASE("plan_batch: says what may change because of what is run") {
        const test::Folder folder;
        Ledger ledger(folder / "ledger", "1");
        ledger.record(task("b"), {}, {}, 1);
        const auto plan = plan_batch({task("a"), task("b", {0})}, ledger, {});
        CHECK(plan[0].why == "new");
        CHECK(plan[1].why == "may change: a is run");
    }
}
