// Work of the library on a thread of its own, so that Python goes on.
#pragma once
#include "bake/base/job.h"
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <pybind11/pybind11.h>
#include <string>

namespace bake::python {
namespace py = pybind11;

/// What the thread of the work and the one of Python tell each other.
struct Watch {
    std::atomic<bool> stop = false; ///< the work is to end with Error{Refusal::interrupted}

    /// From any thread of the work.
    void report(const std::string& step, std::int64_t done, std::int64_t total);

    std::mutex mutex;
    std::string step;
    std::int64_t done = 0, total = 0;
    bool news = false;
};

/// Calls work(watch) on another thread, without the GIL. The calling thread meanwhile looks after signals and calls
/// progress(step, done, total), unless it is None, a few times a second at most. When a signal handler or `progress` raises,
/// the work is stopped and the exception comes out; otherwise what the work throws comes out.
void wait_for(const py::object& progress, const std::function<void(Watch&)>& work);

/// The same for work of the library itself, with at most `threads` threads; 0: as many as there are cores.
void wait_for_job(const py::object& progress, int threads, const std::function<void()>& work);

} // namespace bake::python
