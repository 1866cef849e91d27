#include "bake/picture/decoder_process.h"
#include "bake/base/descriptor.h"
#include "bake/base/memory.h"
#include "bake/base/progress.h"
#include "bake/base/system_lack.h"
#include "bake/picture/decoder_limits.h"
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace bake {
namespace {

constexpr int picture_descriptor = 3, answer_descriptor = 4, first_free_descriptor = 5;
constexpr int look_around_ms = 50; ///< how often a wait looks for interrupts

/// How the process begins: on two descriptors, with nothing to read or print, all signals as they are by default, and those
/// by which a user ends a program blocked: they reach all processes of a terminal, and the parent ends this one.
struct Start {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;

    Start(int picture, int answer) {
        posix_spawn_file_actions_init(&files);
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&files, picture, picture_descriptor);
        posix_spawn_file_actions_adddup2(&files, answer, answer_descriptor);
        posix_spawn_file_actions_addclosefrom_np(&files, first_free_descriptor);
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
        sigset_t all, blocked;
        sigfillset(&all);
        sigemptyset(&blocked);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&blocked, signal);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setsigmask(&attributes, &blocked);
    }
    ~Start() {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
    }
    Start(const Start&) = delete;
    Start& operator=(const Start&) = delete;
};

constexpr const char* others = "give a PNG, EXR or TIFF"; ///< which need no decoder

/// "<path>: its decoder cannot be started <why>; <mend>, or give a PNG, EXR or TIFF"
Error cannot_start(Refusal refusal, const std::string& path, const std::string& why, const std::string& mend) {
    return Error(refusal, path + ": its decoder cannot be started " + why + "; " + mend + ", or " + others);
}

std::string end_by_signal(int signal) {
    switch (signal) {
    case SIGXCPU: return "did not end in time";
    case SIGKILL: return "took too much memory"; // the kernel's way out when there is none left
    default: return "crashed";
    }
}

} // namespace

DecoderProcess::DecoderProcess(const std::string& program, const std::vector<std::string>& arguments,
                               const PictureFile& file)
    : path_(file.path()), program_(program) {
    int ends[2] = {-1, -1};
    const bool piped = pipe2(ends, O_CLOEXEC | O_NONBLOCK) == 0;
    Descriptor ours(ends[0]), pipe_end(ends[1]);
    fcntl(ours.number, F_SETPIPE_SZ, 1 << 20); // fewer switches between the two; not granted to everyone
    // Out of the way of the numbers that they get in the child. The child's writes block.
    const Descriptor theirs(fcntl(pipe_end.number, F_DUPFD_CLOEXEC, 16)), picture(file.duplicate(16));
    fcntl(theirs.number, F_SETFL, O_WRONLY);
    std::vector<char*> argv{const_cast<char*>(program_.c_str())};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const Start start(picture.number, theirs.number);
    const MemoryCapPause uncapped; // the process has limits of its own
    const int failed =
        !piped || theirs.number < 0 || picture.number < 0
            ? EMFILE
            : posix_spawn(&child_, program_.c_str(), &start.files, &start.attributes, argv.data(), environ);
    if (const std::string mend = mend_of_lack(failed); !mend.empty())
        throw cannot_start(Refusal::unsuitable, path_, std::string("(") + std::strerror(failed) + ")", mend);
    if (failed != 0)
        throw cannot_start(Refusal::unreadable, path_, "(" + program_ + ": " + std::strerror(failed) + ")",
                           "mend the installation");
    answer_ = ours.release();
}

DecoderProcess::~DecoderProcess() {
    close(answer_);
    // In a program that leaves its children to the system, the number may be another's by now.
    if (child_ < 0 || waitpid(child_, nullptr, WNOHANG) != 0) return;
    kill(child_, SIGKILL);
    while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void DecoderProcess::allow(std::chrono::seconds time) noexcept { latest_ = std::chrono::steady_clock::now() + time; }

void DecoderProcess::wait_for_answer() const {
    for (;;) {
        throw_if_interrupted();
        if (std::chrono::steady_clock::now() > latest_) throw decoder_failed(path_, "did not end in time");
        pollfd waiting{answer_, POLLIN, 0};
        if (poll(&waiting, 1, look_around_ms) > 0) return;
    }
}

void DecoderProcess::read(void* to, std::size_t size) {
    char* at = static_cast<char*>(to);
    while (size > 0) {
        const ssize_t got = ::read(answer_, at, size);
        if (got == 0) throw end();
        if (got < 0 && errno != EAGAIN && errno != EINTR) throw decoder_failed(path_, "crashed");
        if (got < 0) wait_for_answer();
        else at += got, size -= std::size_t(got);
    }
    answered_ = true;
}

Error DecoderProcess::not_started(int status) const {
    if (const auto limit = binding_limit(0, 0))
        return cannot_start(Refusal::unsuitable, path_, "within " + limit->described(), limit->advice());
    constexpr int by_loader = 127;
    if (WIFEXITED(status) && WEXITSTATUS(status) == by_loader)
        return cannot_start(Refusal::unreadable, path_, "(a library of " + program_ + " is missing)",
                            "mend the installation");
    // Libraries start threads before the program begins.
    return cannot_start(Refusal::unsuitable, path_, "(no thread or no memory is left)", mend_of_lack(EAGAIN));
}

Error DecoderProcess::end() {
    // A closed pipe means that it has ended or is about to, or that damage made it close the pipe.
    int status = 0;
    pid_t ended = 0;
    for (int ms = 0; ms < 1000 && (ended = waitpid(child_, &status, WNOHANG)) == 0; ++ms)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (ended != 0) child_ = -1;
    throw_if_interrupted();
    if (ended > 0 && !answered_) return not_started(status);
    return decoder_failed(path_, ended > 0 && WIFSIGNALED(status) ? end_by_signal(WTERMSIG(status)) : "crashed");
}

} // namespace bake
