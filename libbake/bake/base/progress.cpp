#include "bake/base/progress.h"
#include "bake/base/error.h"
#include "bake/base/interruption.h"
#include "bake/base/job.h"
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <unistd.h>

namespace bake {
namespace {

volatile std::sig_atomic_t stop_requested = 0;
std::atomic<int> shields = 0;

/// A file that is not finished. Its path stays where it is, as the handler may read it at any time.
struct UnfinishedFile {
    std::atomic<bool> taken, ready;
    char path[4096];
};
UnfinishedFile unfinished[256];

constexpr const char* out_of_time = "out of processor time (ulimit -t), nothing was written; raise ulimit -t";

/// For the handler: the kernel sends SIGXCPU each second, and the second one may come before the first one is looked at.
void print_out_of_time() noexcept {
    for (const char* part : {"bake: ", out_of_time, "\n"})
        if (write(STDERR_FILENO, part, std::strlen(part)) < 0) return;
}

void on_signal(int signal) {
    if (stop_requested && shields == 0) {
        for (const UnfinishedFile& file : unfinished)
            if (file.ready) unlink(file.path);
        if (signal == SIGXCPU) print_out_of_time();
        _exit(int(Refusal::interrupted));
    }
    stop_requested = signal;
}

} // namespace

void catch_interrupts() noexcept {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGXCPU, &action, nullptr);
    struct sigaction before {};
    if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
    // A file over the size limit must come back from write() as an error, not kill us with the output half done.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() noexcept { return stop_requested != 0 && !current_job().stop_accepted; }

bool accept_interrupt() noexcept {
    if (!stop_requested || stop_requested == SIGXCPU) return false;
    current_job().stop_accepted = true;
    return true;
}

void throw_if_interrupted() {
    if (interrupted())
        throw Error(Refusal::interrupted, stop_requested == SIGXCPU ? out_of_time : "interrupted; nothing was written");
}

int remove_on_second_signal(const std::string& path) noexcept {
    if (path.size() >= sizeof UnfinishedFile::path) return -1;
    for (int slot = 0; slot < int(std::size(unfinished)); ++slot) {
        UnfinishedFile& file = unfinished[slot];
        if (file.taken.exchange(true)) continue;
        std::memcpy(file.path, path.c_str(), path.size() + 1);
        file.ready = true;
        return slot;
    }
    return -1;
}

void forget_unfinished(int slot) noexcept {
    if (slot < 0) return;
    unfinished[slot].ready = false;
    unfinished[slot].taken = false;
}

SignalShield::SignalShield() noexcept { ++shields; }
SignalShield::~SignalShield() { --shields; }

Progress::Progress(bool quiet) : visible_(!quiet && draws_on_terminal()) {}

Progress::~Progress() { finish(); }

void Progress::start(const std::string& step, std::int64_t total) {
    finish();
    step_ = step;
    total_ = total;
    done_ = 0;
    percent_ = -1;
    if (!visible_ || total > 0) return;
    std::fprintf(stderr, "\r%s ...", step_.c_str());
    std::fflush(stderr);
    drawn_ = true;
}

void Progress::add(std::int64_t units) noexcept {
    const std::int64_t done = done_.fetch_add(units, std::memory_order_relaxed) + units;
    if (visible_ && total_ > 0) draw(done);
}

void Progress::draw(std::int64_t done) noexcept {
    const int percent = int(100 * done / total_);
    int shown = percent_.load(std::memory_order_relaxed);
    if (percent <= shown || !percent_.compare_exchange_strong(shown, percent)) return;
    const int width = 32;
    char bar[width + 1];
    for (int i = 0; i < width; ++i) bar[i] = i * 100 < percent * width ? '#' : '.';
    bar[width] = '\0';
    std::fprintf(stderr, "\r%-12s [%s] %3d %%", step_.c_str(), bar, percent);
    std::fflush(stderr);
    drawn_ = true;
}

void Progress::finish() noexcept {
    if (drawn_) std::fputs("\r\033[K", stderr);
    drawn_ = false;
}

} // namespace bake
