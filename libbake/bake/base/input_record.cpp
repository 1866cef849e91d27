#include "bake/base/input_record.h"
#include <atomic>
#include <mutex>
#include <set>
#include <sys/stat.h>
#include <utility>

namespace bake {

struct InputRecord::Files {
    std::mutex mutex;
    std::set<std::pair<dev_t, ino_t>> known;
};

namespace {

std::atomic<InputRecord::Files*> current = nullptr;

} // namespace

InputRecord::InputRecord() : files_(std::make_unique<Files>()) { current = files_.get(); }
InputRecord::~InputRecord() { current = nullptr; }

void remember_input(const struct stat& file) {
    InputRecord::Files* const files = current;
    if (!files) return;
    const std::lock_guard lock(files->mutex);
    files->known.emplace(file.st_dev, file.st_ino);
}

bool is_input(const struct stat& file) {
    InputRecord::Files* const files = current;
    if (!files) return false;
    const std::lock_guard lock(files->mutex);
    return files->known.contains({file.st_dev, file.st_ino});
}

} // namespace bake
