#include "bake/base/input_record.h"
#include "bake/base/content_hash.h"
#include "bake/base/job.h"
#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <sys/stat.h>
#include <tuple>
#include <utility>

namespace bake {

struct InputFiles {
    std::mutex mutex;
    struct Named {
        std::string path, hash;
    };
    std::map<std::pair<dev_t, ino_t>, Named> known;
};

InputRecord::InputRecord() : files_(std::make_unique<InputFiles>()) { current_job().inputs = files_.get(); }
InputRecord::~InputRecord() { current_job().inputs = nullptr; }

void remember_input(const std::string& path, const struct stat& file) {
    InputFiles* const files = current_job().inputs;
    if (!files) return;
    const std::lock_guard lock(files->mutex);
    files->known.emplace(std::pair(file.st_dev, file.st_ino), InputFiles::Named{path, ""});
}

bool is_input(const struct stat& file) {
    InputFiles* const files = current_job().inputs;
    if (!files) return false;
    const std::lock_guard lock(files->mutex);
    return files->known.contains({file.st_dev, file.st_ino});
}

std::vector<InputFile> recorded_inputs() {
    InputFiles* const files = current_job().inputs;
    if (!files) return {};
    std::vector<InputFile> out;
    const std::lock_guard lock(files->mutex);
    for (auto& [file, named] : files->known) {
        if (named.hash.empty()) named.hash = file_hash(named.path).value_or("");
        out.push_back({named.path, std::filesystem::path(named.path).filename().string(), named.hash});
    }
    std::sort(out.begin(), out.end(), [](const InputFile& a, const InputFile& b) {
        return std::tie(a.name, a.hash) < std::tie(b.name, b.hash);
    });
    return out;
}

} // namespace bake
