#include "wait.h"
#include "bake/base/run_job.h"
#include <chrono>
#include <condition_variable>
#include <exception>
#include <optional>
#include <thread>

namespace bake::python {
namespace {

struct News {
    std::string step;
    std::int64_t done = 0, total = 0;
};

std::optional<News> take_news(Watch& watch) {
    const std::lock_guard lock(watch.mutex);
    if (!std::exchange(watch.news, false)) return {};
    return News{watch.step, watch.done, watch.total};
}

/// What Python has to do meanwhile. Raises what it raises.
void look_after(Watch& watch, const py::object& progress) {
    if (const auto news = take_news(watch); news && !progress.is_none()) progress(news->step, news->done, news->total);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

} // namespace

void Watch::report(const std::string& now, std::int64_t units, std::int64_t all) {
    const std::lock_guard lock(mutex);
    step = now, done = units, total = all, news = true;
}

void wait_for(const py::object& progress, const std::function<void(Watch&)>& work) {
    Watch watch;
    std::mutex mutex;
    std::condition_variable ended;
    bool over = false;
    std::exception_ptr failure;
    std::thread worker([&] {
        try {
            work(watch);
        } catch (...) {
            failure = std::current_exception();
        }
        const std::lock_guard lock(mutex);
        over = true;
        ended.notify_one();
    });
    std::optional<py::error_already_set> raised;
    for (bool last = false; !last;) {
        {
            const py::gil_scoped_release released;
            std::unique_lock lock(mutex);
            last = ended.wait_for(lock, std::chrono::milliseconds(50), [&] { return over; });
        }
        if (raised) continue;
        try {
            look_after(watch, progress);
        } catch (py::error_already_set& error) {
            raised.emplace(std::move(error));
            watch.stop = true;
        }
    }
    worker.join();
    if (raised) throw py::error_already_set(std::move(*raised));
    if (failure) std::rethrow_exception(failure);
}

void wait_for_job(const py::object& progress, int threads, const std::function<void()>& work) {
    wait_for(progress, [&](Watch& watch) {
        Job job;
        job.threads = threads;
        job.draws = false;
        job.stops = [&] { return watch.stop.load(); };
        job.watch = [&](const std::string& step, std::int64_t done, std::int64_t total) {
            watch.report(step, done, total);
        };
        run_job(job, work);
    });
}

} // namespace bake::python
