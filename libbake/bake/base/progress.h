// Progress display and interruption of long work.
#pragma once
#include <atomic>
#include <cstdint>
#include <string>

namespace bake {

/// A bar on stderr, drawn only when stderr is a terminal and `quiet` is false; silent otherwise.
/// add() may be called from any thread.
class Progress {
public:
    explicit Progress(bool quiet = true);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Begins a step of `total` units under a short name, such as "bake"; 0: unknown, and the name stands for the bar.
    void start(const std::string& step, std::int64_t total);
    void add(std::int64_t units) noexcept;
    /// Wipes the bar, so that results can be printed.
    void finish() noexcept;

private:
    void draw(std::int64_t done) noexcept;

    bool visible_ = false;
    bool drawn_ = false;
    std::string step_;
    std::int64_t total_ = 0;
    std::atomic<std::int64_t> done_{0};
    std::atomic<int> percent_{-1};
};

/// Makes Ctrl-C and SIGTERM set a flag that long work looks at; a second signal ends the process at once, after
/// removing the unfinished output registered with `remove_on_second_signal`.
void catch_interrupts() noexcept;
/// True once the user has asked to stop.
bool interrupted() noexcept;
/// Throws Error{Refusal::interrupted} once the user has asked to stop.
void throw_if_interrupted();
/// Names the one unfinished file (empty: none) a second signal removes. The path must be shorter than 4096 bytes.
void remove_on_second_signal(const std::string& path) noexcept;

} // namespace bake
