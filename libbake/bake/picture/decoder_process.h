// A decoder in a process of its own: what happens to it, happens to its picture alone.
#pragma once
#include "bake/picture/picture_file.h"
#include <chrono>
#include <string>
#include <sys/types.h>
#include <vector>

namespace bake {

class DecoderProcess {
public:
    /// Starts `program`, which inherits nothing but the open picture as descriptor 3 and a pipe for its answer as
    /// descriptor 4. Throws Error{Refusal::unreadable} when it cannot be started, Error{Refusal::unsuitable} when the system
    /// has no process or descriptor left for it.
    DecoderProcess(const std::string& program, const std::vector<std::string>& arguments, const PictureFile& file);
    /// Ends it.
    ~DecoderProcess();
    DecoderProcess(const DecoderProcess&) = delete;
    DecoderProcess& operator=(const DecoderProcess&) = delete;

    /// How long from now the process may take, at most; without a call, for ever.
    void allow(std::chrono::seconds time) noexcept;
    /// The next `size` bytes of the answer. Throws Error{Refusal::interrupted} soon after an interrupt, and
    /// Error{Refusal::unreadable} when the process ended before, or took too long; Error{Refusal::unsuitable} when it ended
    /// before its first answer, so that the picture is not at fault.
    void read(void* to, std::size_t size);

private:
    /// Waits until there is something to read, or the end.
    void wait_for_answer() const;
    /// The reason why the answer ended.
    Error end();
    Error not_started(int status) const;

    std::string path_, program_;
    std::chrono::steady_clock::time_point latest_ = std::chrono::steady_clock::time_point::max();
    bool answered_ = false;
    int answer_ = -1; ///< our end of the pipe
    pid_t child_ = -1;
};

} // namespace bake
