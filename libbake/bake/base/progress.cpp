#include "bake/base/progress.h"
#include "bake/base/error.h"
#include <csignal>
#include <cstdio>
#include <cstring>
#include <unistd.h>

namespace bake {
namespace {

volatile std::sig_atomic_t stop_requested = 0;
char unfinished_path[4096] = "";

void on_signal(int) {
    if (stop_requested) {
        if (unfinished_path[0]) unlink(unfinished_path);
        _exit(int(Refusal::interrupted));
    }
    stop_requested = 1;
}

} // namespace

void catch_interrupts() noexcept {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    // A file over the size limit must come back from write() as an error, not kill us with the output half done.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() noexcept { return stop_requested != 0; }

void throw_if_interrupted() {
    if (interrupted()) throw Error(Refusal::interrupted, "interrupted; nothing was written");
}

void remove_on_second_signal(const std::string& path) noexcept {
    unfinished_path[0] = '\0'; // first, so that the handler never sees half a name
    if (path.empty() || path.size() >= sizeof unfinished_path) return;
    std::memcpy(unfinished_path + 1, path.c_str() + 1, path.size());
    unfinished_path[0] = path[0];
}

Progress::Progress(bool quiet) : visible_(!quiet && isatty(STDERR_FILENO)) {}

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
