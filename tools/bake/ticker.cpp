#include "ticker.h"
#include "bake/base/job.h"
#include "bake/base/printable.h"
#include <chrono>
#include <cstdio>
#include <system_error>
#include <utility>

namespace bake {

Ticker::Ticker(bool visible, std::function<std::string()> text) : text_(std::move(text)) {
    if (!visible || !draws_on_terminal()) return;
    try {
        thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) { // a limit on threads: the work goes on without the line
    }
}

Ticker::~Ticker() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        end_ = true;
    }
    ended_.notify_one();
    thread_.join();
    std::fputs("\r\033[K", stderr);
}

void Ticker::run() {
    std::unique_lock lock(mutex_);
    do {
        std::fprintf(stderr, "\r\033[K%s", printable(text_()).c_str());
        std::fflush(stderr);
    } while (!ended_.wait_for(lock, std::chrono::milliseconds(500), [this] { return end_; }));
}

} // namespace bake
