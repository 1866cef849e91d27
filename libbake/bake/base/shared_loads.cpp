#include "bake/base/shared_loads.h"
#include <algorithm>
#include <atomic>
#include <sys/stat.h>

namespace bake {
namespace {

std::atomic<SharedLoads*> of_process = nullptr;

} // namespace

SharedLoads* shared_loads() noexcept { return of_process; }

std::optional<FileStamp> stamp_of_input(const std::string& path) {
    struct stat file {};
    if (stat(path.c_str(), &file) != 0 || !S_ISREG(file.st_mode)) return {};
    remember_input(path, file);
    return stamp_of(file);
}

SharedLoads::SharedLoads(std::unordered_set<std::string> files, std::size_t most_bytes)
    : files_(std::move(files)), most_bytes_(most_bytes) {
    of_process = this;
}

SharedLoads::~SharedLoads() { of_process = nullptr; }

SharedLoads::Pause::Pause(SharedLoads& loads) : loads_(loads) {
    const std::lock_guard lock(loads_.mutex_);
    loads_.paused_ = true;
    loads_.loads_.clear();
    loads_.bytes_ = 0;
}

SharedLoads::Pause::~Pause() {
    const std::lock_guard lock(loads_.mutex_);
    loads_.paused_ = false;
}

bool SharedLoads::is_shared(const std::string& path) {
    const std::lock_guard lock(mutex_);
    return !paused_ && files_.contains(path);
}

std::shared_ptr<const void> SharedLoads::find(const std::string& key, const FileStamp& now) {
    const std::lock_guard lock(mutex_);
    const auto found = loads_.find(key);
    if (found == loads_.end() || found->second.stamp != now) return {};
    found->second.used = ++uses_;
    return found->second.value;
}

bool SharedLoads::fits(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    return !paused_ && bytes <= most_bytes_;
}

void SharedLoads::keep(const std::string& key, Load load) {
    const std::lock_guard lock(mutex_);
    if (paused_ || load.bytes > most_bytes_) return;
    load.used = ++uses_;
    bytes_ += load.bytes;
    Load& slot = loads_[key];
    bytes_ -= slot.bytes;
    slot = std::move(load);
    while (bytes_ > most_bytes_) {
        const auto oldest = std::min_element(
            loads_.begin(), loads_.end(), [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
        bytes_ -= oldest->second.bytes;
        loads_.erase(oldest);
    }
}

} // namespace bake
