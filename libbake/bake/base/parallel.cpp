#include "bake/base/parallel.h"
#include "bake/base/job.h"
#include "bake/base/progress.h"
#include <algorithm>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>

namespace bake {

struct ThreadLimit::Control {
    tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads) {
    if (threads > 0) control_.reset(new Control{{tbb::global_control::max_allowed_parallelism, std::size_t(threads)}});
}

ThreadLimit::~ThreadLimit() = default;

int thread_count() noexcept {
    if (const int of_job = current_job().threads; of_job > 0) return of_job;
    const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::max(1, int(allowed));
}

void detail::for_rows(std::int64_t rows, std::int64_t grain, void (*work)(void*, std::int64_t, std::int64_t),
                      void* context, Progress* progress) {
    grain = std::max<std::int64_t>(1, grain);
    const std::int64_t chunks = (rows + grain - 1) / grain;
    tbb::parallel_for(std::int64_t(0), chunks, [=](std::int64_t chunk) {
        throw_if_interrupted();
        const std::int64_t begin = chunk * grain, end = std::min(rows, begin + grain);
        work(context, begin, end);
        if (progress) progress->add(end - begin);
    });
    throw_if_interrupted();
}

int slot_count() noexcept { return thread_count() + 1; }

void detail::in_order(std::int64_t bands, void (*compute)(void*, std::int64_t, int),
                      void (*consume)(void*, std::int64_t, int), void* compute_context, void* consume_context) {
    // At most `slots` bands are under way and they leave in order, so band % slots is free when a band starts.
    const int slots = slot_count();
    std::int64_t next = 0;
    const auto source = [&](tbb::flow_control& control) {
        if (next == bands) control.stop();
        return next++;
    };
    const auto work = [&](std::int64_t band) {
        throw_if_interrupted();
        compute(compute_context, band, int(band % slots));
        return band;
    };
    const auto sink = [&](std::int64_t band) { consume(consume_context, band, int(band % slots)); };
    using tbb::filter_mode;
    tbb::parallel_pipeline(std::size_t(slots),
                           tbb::make_filter<void, std::int64_t>(filter_mode::serial_in_order, source) &
                               tbb::make_filter<std::int64_t, std::int64_t>(filter_mode::parallel, work) &
                               tbb::make_filter<std::int64_t, void>(filter_mode::serial_in_order, sink));
    throw_if_interrupted();
}

} // namespace bake
