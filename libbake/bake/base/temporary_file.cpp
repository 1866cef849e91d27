#include "bake/base/temporary_file.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace bake {
namespace fs = std::filesystem;

namespace {

// Names do not depend on the target's, which may be as long as the file system permits.
constexpr std::string_view prefix = ".bake-", suffix = ".tmp";
constexpr std::size_t digits = 16;

std::string random_name() {
    std::uint64_t number = 0;
    // Without enough entropy at the start of a machine, the clock and O_EXCL do.
    if (getrandom(&number, sizeof number, GRND_NONBLOCK) != sizeof number) {
        timespec now{};
        clock_gettime(CLOCK_REALTIME, &now);
        number = std::uint64_t(now.tv_nsec) << 32 ^ std::uint64_t(now.tv_sec) ^ std::uint64_t(getpid()) << 20;
    }
    return std::string(prefix) + format("%016llx", static_cast<unsigned long long>(number)) + std::string(suffix);
}

bool is_temporary_name(const std::string& name) {
    return name.size() == prefix.size() + digits + suffix.size() && name.starts_with(prefix) &&
           name.ends_with(suffix) && std::all_of(name.begin() + prefix.size(), name.end() - suffix.size(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
           });
}

/// Removes a temporary file unless it is locked, which a live one is.
void remove_if_left(const fs::path& path) {
    const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return;
    struct stat status {};
    if (fstat(file, &status) == 0 && S_ISREG(status.st_mode) && flock(file, LOCK_EX | LOCK_NB) == 0)
        unlink(path.c_str());
    close(file);
}

/// Locks a file that was just made. False if another run removed it before it was locked.
bool hold(int file) {
    // File systems without locks keep what killed runs leave.
    if (flock(file, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
    struct stat status {};
    return fstat(file, &status) == 0 && status.st_nlink > 0;
}

} // namespace

void sweep_temporary_files(const fs::path& folder) {
    std::error_code failed;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, failed), end; !failed && entry != end;
         entry.increment(failed))
        if (is_temporary_name(entry->path().filename().string())) remove_if_left(entry->path());
}

TemporaryFile::TemporaryFile(const std::string& folder, bool nameless) {
    const fs::path where = folder.empty() ? fs::path(".") : fs::path(folder);
    constexpr int attempts = 100;
    for (int attempt = 0; attempt < attempts && descriptor_ < 0; ++attempt) {
        path_ = (where / random_name()).string();
        descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno != EEXIST) return;
        if (descriptor_ >= 0 && !hold(descriptor_)) close(std::exchange(descriptor_, -1));
    }
    if (descriptor_ < 0) return;
    if (nameless) unlink(path_.c_str()), path_.clear();
    else slot_ = remove_on_second_signal(path_);
}

TemporaryFile::TemporaryFile(TemporaryFile&& from) noexcept
    : path_(std::exchange(from.path_, {})), descriptor_(std::exchange(from.descriptor_, -1)),
      slot_(std::exchange(from.slot_, -1)) {}

TemporaryFile::~TemporaryFile() {
    if (descriptor_ < 0) return;
    // Removed while it is locked: afterwards the name may be another run's.
    if (!path_.empty()) unlink(path_.c_str());
    forget_unfinished(slot_);
    close(descriptor_);
}

bool TemporaryFile::rename_to(const fs::path& target) noexcept {
    if (std::rename(path_.c_str(), target.c_str()) != 0) return false;
    path_.clear();
    forget_unfinished(std::exchange(slot_, -1));
    return true;
}

} // namespace bake
