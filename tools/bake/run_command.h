// Commands run within a process: by the program `bake`, and by what runs many of them.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace bake {

struct CommandIo {
    /// Take what the command prints as text and as reasons, whole lines at a time, from any of its threads; empty: stdout
    /// and stderr of the process.
    std::function<void(const std::string&)> print, tell;
    bool draws = false; ///< progress is drawn on stderr, where that is a terminal
    /// Called when the words are understood, before the work, with the number of threads that were asked for, 0: any.
    std::function<void(int threads)> begins;
};

/// Runs `bake WORDS...` and returns its exit code, whatever happens: nothing is thrown. Paths are relative to the working
/// directory of the process. Several commands can run at the same time, on threads of their own; they share the limits of
/// the process and its signals (catch_interrupts()): Ctrl-C ends all of them.
int run_command(const std::vector<std::string>& words, const CommandIo& io);

} // namespace bake
