// The one exception of bake: a refusal of what the user gave us. Our own bugs are asserts.
#pragma once
#include <stdexcept>
#include <string>

namespace bake {

/// Why a run is refused. The value is the exit code of the command.
enum class Refusal {
    over_limit = 1,    ///< done, but over a limit the user gave
    usage = 2,         ///< wrong options
    unreadable = 3,    ///< input that cannot be read
    unsuitable = 4,    ///< readable, but unfit for the job, or too large for the memory it may use
    unwritable = 5,    ///< output that cannot be written
    interrupted = 130, ///< Ctrl-C
};

/// what() is one line: "<file>: <what is wrong>; <how to mend it>".
class Error : public std::runtime_error {
public:
    Error(Refusal why, const std::string& message) : std::runtime_error(message), refusal(why) {}
    Refusal refusal;
};

} // namespace bake
