// Work split over rows. Each row has one writer, so any number of threads gives the same bytes.
#pragma once
#include <cstdint>
#include <memory>
#include <type_traits>

namespace bake {

class Progress;

/// During the lifetime of this object at most `threads` threads work; 0 means one per core. Its end may start threads that
/// were not allowed before, and ends the program (std::terminate) when the system has none: where that can be, keep it for
/// as long as the program runs.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    struct Control;
    std::unique_ptr<Control> control_;
};

/// How many threads for_rows may use now.
int thread_count() noexcept;

namespace detail {
void for_rows(std::int64_t rows, std::int64_t grain, void (*work)(void*, std::int64_t, std::int64_t), void* context,
              Progress* progress);
void in_order(std::int64_t bands, void (*compute)(void*, std::int64_t, int), void (*consume)(void*, std::int64_t, int),
              void* compute_context, void* consume_context);

template <class Work> void* context_of(Work& work) {
    return const_cast<void*>(static_cast<const void*>(std::addressof(work)));
}
} // namespace detail

/// Calls work(begin, end) on chunks of at most `grain` rows that together cover [0, rows) once, on all threads, in any
/// order. The chunks do not depend on the number of threads. for_rows rethrows an exception of a chunk; Ctrl-C comes
/// out as Error{Refusal::interrupted}. `progress`, when given, advances by one unit per row.
template <class Work> void for_rows(std::int64_t rows, std::int64_t grain, Work&& work, Progress* progress = nullptr) {
    const auto call = [](void* context, std::int64_t begin, std::int64_t end) {
        (*static_cast<std::remove_reference_t<Work>*>(context))(begin, end);
    };
    detail::for_rows(rows, grain, call, detail::context_of(work), progress);
}

/// Slots that in_order works with now: as many buffers as its caller needs.
int slot_count() noexcept;

/// A pipeline over bands: compute(band, slot) on any thread, several bands at a time; consume(band, slot) one at a time
/// and in the order of the bands, while later bands are being computed. A band keeps its slot, in [0, slot_count()), to
/// itself until it is consumed. Exceptions and Ctrl-C come out as from for_rows.
template <class Compute, class Consume> void in_order(std::int64_t bands, Compute&& compute, Consume&& consume) {
    using C = std::remove_reference_t<Compute>;
    using S = std::remove_reference_t<Consume>;
    detail::in_order(
        bands, [](void* context, std::int64_t band, int slot) { (*static_cast<C*>(context))(band, slot); },
        [](void* context, std::int64_t band, int slot) { (*static_cast<S*>(context))(band, slot); },
        detail::context_of(compute), detail::context_of(consume));
}

} // namespace bake
