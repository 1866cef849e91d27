// A line on a terminal that is written anew twice a second while work goes on.
#pragma once
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace bake {

/// Shows text() on stderr until it ends, from a thread of its own. Without a terminal, when not `visible`, or when no
/// thread can be started, nothing is shown.
class Ticker {
public:
    Ticker(bool visible, std::function<std::string()> text);
    /// Wipes the line.
    ~Ticker();
    Ticker(const Ticker&) = delete;
    Ticker& operator=(const Ticker&) = delete;

private:
    void run();

    std::function<std::string()> text_;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool end_ = false;
    std::thread thread_;
};

} // namespace bake
