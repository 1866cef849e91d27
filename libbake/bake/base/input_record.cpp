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
        std::string path;
        FileStamp stamp;
        std::optional<std::string> hash = {}; ///< of what was read; nothing: it is still being read
    };
    std::map<std::pair<dev_t, ino_t>, Named> known;
};

InputRecord::InputRecord() : files_(std::make_unique<InputFiles>()) { current_job().inputs = files_.get(); }
InputRecord::~InputRecord() { current_job().inputs = nullptr; }

void remember_input(const std::string& path, const struct stat& file) {
    InputFiles* const files = current_job().inputs;
    if (!files) return;
    const std::lock_guard lock(files->mutex);
    files->known.emplace(std::pair(file.st_dev, file.st_ino), InputFiles::Named{path, stamp_of(file)});
}

void input_was_read(int descriptor) {
    InputFiles* const files = current_job().inputs;
    struct stat file {};
    if (!files || fstat(descriptor, &file) != 0) return;
    const std::pair key(file.st_dev, file.st_ino);
    const auto is_known = [&] {
        const std::lock_guard lock(files->mutex);
        const auto known = files->known.find(key);
        return known == files->known.end() || (known->second.hash && known->second.stamp == stamp_of(file));
    };
    if (is_known()) return;
    const std::string hash = file_hash(descriptor).value_or("");
    const bool same = fstat(descriptor, &file) == 0;
    const std::lock_guard lock(files->mutex);
    InputFiles::Named& named = files->known.at(key);
    named.hash = same && stamp_of(file) == named.stamp ? hash : "";
}

bool is_input(const struct stat& file) {
    InputFiles* const files = current_job().inputs;
    if (!files) return false;
    const std::lock_guard lock(files->mutex);
    return files->known.contains({file.st_dev, file.st_ino});
}

FileStamp stamp_of(const struct stat& file) noexcept {
    constexpr std::int64_t second = 1'000'000'000;
    return {std::int64_t(file.st_size), std::int64_t(file.st_mtim.tv_sec) * second + file.st_mtim.tv_nsec,
            std::uint64_t(file.st_ino)};
}

std::optional<FileStamp> stamp_at(const std::string& path) {
    struct stat file {};
    return stat(path.c_str(), &file) == 0 ? std::optional(stamp_of(file)) : std::nullopt;
}

namespace {

/// Of a file that is still being read: what was read of one that has changed since it was opened is not known.
std::string hash_of(const std::string& path, const FileStamp& opened) {
    const std::string hash = file_hash(path).value_or("");
    return stamp_at(path) == opened ? hash : "";
}

} // namespace

std::vector<ReadFile> files_read() {
    InputFiles* const files = current_job().inputs;
    if (!files) return {};
    std::vector<ReadFile> out;
    const std::lock_guard lock(files->mutex);
    for (const auto& [file, named] : files->known) out.push_back({named.path, named.stamp});
    return out;
}

std::vector<InputFile> recorded_inputs() {
    InputFiles* const files = current_job().inputs;
    if (!files) return {};
    std::vector<InputFile> out;
    const std::lock_guard lock(files->mutex);
    for (auto& [file, named] : files->known) {
        if (!stamp_at(named.path)) continue; // a temporary file of our own
        out.push_back({named.path, std::filesystem::path(named.path).filename().string(),
                       named.hash ? *named.hash : hash_of(named.path, named.stamp)});
    }
    std::sort(out.begin(), out.end(), [](const InputFile& a, const InputFile& b) {
        return std::tie(a.name, a.hash) < std::tie(b.name, b.hash);
    });
    return out;
}

} // namespace bake
