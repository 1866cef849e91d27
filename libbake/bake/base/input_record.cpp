#include "bake/base/input_record.h"
#include "bake/base/job.h"
#include <mutex>
#include <set>
#include <sys/stat.h>
#include <utility>

namespace bake {

struct InputFiles {
    std::mutex mutex;
    std::set<std::pair<dev_t, ino_t>> known;
};

InputRecord::InputRecord() : files_(std::make_unique<InputFiles>()) { current_job().inputs = files_.get(); }
InputRecord::~InputRecord() { current_job().inputs = nullptr; }

void remember_input(const struct stat& file) {
    InputFiles* const files = current_job().inputs;
    if (!files) return;
    const std::lock_guard lock(files->mutex);
    files->known.emplace(file.st_dev, file.st_ino);
}

bool is_input(const struct stat& file) {
    InputFiles* const files = current_job().inputs;
    if (!files) return false;
    const std::lock_guard lock(files->mutex);
    return files->known.contains({file.st_dev, file.st_ino});
}

} // namespace bake
