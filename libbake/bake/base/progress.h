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

/// Makes Ctrl-C, SIGTERM, SIGHUP (unless it is ignored, as nohup has it) and SIGXCPU (the limit on processor time) set a
/// flag that long work looks at; a second signal ends the process at once, after removing the unfinished files.
void catch_interrupts() noexcept;
/// True once the user has asked to stop.
bool interrupted() noexcept;
/// Throws Error{Refusal::interrupted} once the user has asked to stop.
void throw_if_interrupted();

/// Names a file that a second signal removes. Returns a number for forget_unfinished(), -1 if there are too many files. From
/// any thread.
int remove_on_second_signal(const std::string& path) noexcept;
/// Ends what remove_on_second_signal() began; -1 does nothing.
void forget_unfinished(int slot) noexcept;

/// While it lives, a second signal does not end the process.
class SignalShield {
public:
    SignalShield() noexcept;
    ~SignalShield();
    SignalShield(const SignalShield&) = delete;
    SignalShield& operator=(const SignalShield&) = delete;
};

} // namespace bake
