// Work split over rows. Each row has one writer, so any number of threads gives the same bytes.
#pragma once
#include <cstdint>
#include <memory>

namespace bake {

class Progress;

/// While it lives, at most `threads` threads work; 0 means one per core.
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
}

/// Calls work(begin, end) on chunks of at most `grain` rows that together cover [0, rows) once, on all threads, in any
/// order. The chunks do not depend on the number of threads. An exception from a chunk comes out here; Ctrl-C comes
/// out as Error{Refusal::interrupted}. `progress`, when given, advances by one unit per row.
template <class Work>
void for_rows(std::int64_t rows, std::int64_t grain, Work&& work, Progress* progress = nullptr) {
    const auto call = [](void* context, std::int64_t begin, std::int64_t end) {
        (*static_cast<std::remove_reference_t<Work>*>(context))(begin, end);
    };
    detail::for_rows(rows, grain, call, const_cast<void*>(static_cast<const void*>(std::addressof(work))), progress);
}

} // namespace bake
