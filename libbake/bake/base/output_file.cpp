#include "bake/base/output_file.h"
#include "bake/base/error.h"
#include "bake/base/input_record.h"
#include "bake/base/job.h"
#include "bake/base/progress.h"
#include "bake/base/system_lack.h"
#include "bake/base/temporary_file.h"
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace bake {
namespace fs = std::filesystem;

namespace {

/// The part of a name that other programs replace by the number of a tile or of a frame; empty if there is none.
std::string number_place(const std::string& written) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
    std::string name = written;
    std::transform(name.begin(), name.end(), name.begin(), lower);
    for (const char* place : {"<udim>", "<uvtile>", "<tile>", "%(udim)d"})
        if (const std::size_t at = name.find(place); at != std::string::npos)
            return written.substr(at, std::string(place).size());
    for (std::size_t at = name.find('%'); at != std::string::npos; at = name.find('%', at + 1)) {
        std::size_t end = at + 1;
        while (end < name.size() && std::isdigit(static_cast<unsigned char>(name[end]))) ++end;
        const bool word = end + 1 < name.size() && std::isalnum(static_cast<unsigned char>(name[end + 1]));
        if (end < name.size() && name[end] == 'd' && !word) return name.substr(at, end + 1 - at);
    }
    return {};
}

[[noreturn]] void refuse_name(const std::string& path, const std::string& reason, const std::string& mend) {
    throw Error(Refusal::unwritable, path + ": cannot be written (" + reason + "); " + mend);
}

/// A call of the system failed, and errno says why.
[[noreturn]] void refuse_call(const std::string& path, const char* mend) {
    const int reason = errno;
    const std::string lack = mend_of_lack(reason);
    refuse_name(path, std::strerror(reason), lack.empty() ? mend : lack);
}

/// The file that a chain of symbolic links names, which need not be there.
fs::path followed(const std::string& path) {
    constexpr int most_links = 40; // as many as Linux follows
    fs::path target = path;
    std::error_code ignored;
    for (int links = 0; fs::is_symlink(fs::symlink_status(target, ignored)); ++links) {
        if (links == most_links) refuse_name(path, std::strerror(ELOOP), "choose another name");
        target = target.parent_path() / fs::read_symlink(target, ignored);
    }
    return target;
}

bool is_null_device(const struct stat& file) {
    struct stat null {};
    return S_ISCHR(file.st_mode) && stat(null_device, &null) == 0 && file.st_rdev == null.st_rdev;
}

/// Refuses to replace inputs and what is not a file.
void check_target(const std::string& path, const fs::path& target) {
    struct stat file {};
    if (path.empty() || target.filename().empty()) refuse_name(path, "it is a folder", "name a file in it");
    if (stat(target.c_str(), &file) != 0 || is_null_device(file)) return;
    if (S_ISDIR(file.st_mode)) refuse_name(path, "it is a folder", "name a file in it");
    if (!S_ISREG(file.st_mode)) refuse_name(path, "it is not a regular file", "choose another name");
    if (is_input(file))
        throw Error(Refusal::usage, path + ": would replace a file that the output is made from; choose another name");
}

/// Gives the new file the owner and the mode of the one that it replaces, as far as the system permits.
void keep_rights(const TemporaryFile& made, const fs::path& target) {
    struct stat old {};
    if (stat(target.c_str(), &old) != 0) return;
    const bool owned = fchown(made.descriptor(), old.st_uid, old.st_gid) == 0;
    // Rights of a group are not given to another group.
    const mode_t rights = owned ? 07777 : 0777;
    if (fchmod(made.descriptor(), old.st_mode & rights) != 0) return;
}

std::string listed(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

} // namespace

struct OutputFile::Reserved {
    std::string path; ///< as it was given
    fs::path target;  ///< after links; empty for the null device
    TemporaryFile file;
};

struct OutputSet::Files {
    std::mutex mutex;
    std::vector<std::unique_ptr<OutputFile::Reserved>> written;
    std::vector<fs::path> swept; ///< folders without the temporary files of killed runs
};

namespace {

using Reserved = OutputFile::Reserved;

/// Two outputs of one name would replace each other.
void refuse_repeats(const std::vector<std::unique_ptr<Reserved>>& files) {
    std::vector<fs::path> names;
    for (const auto& file : files) {
        if (file->target.empty()) continue;
        std::error_code ignored;
        const fs::path folder = file->target.has_parent_path() ? file->target.parent_path() : ".";
        fs::path name = fs::canonical(folder, ignored) / file->target.filename();
        if (std::find(names.begin(), names.end(), name) != names.end())
            throw Error(Refusal::usage, file->path + ": is the name of two outputs; choose another name for one");
        names.push_back(std::move(name));
    }
}

void rename_all(std::vector<std::unique_ptr<Reserved>> files) {
    throw_if_interrupted();
    refuse_repeats(files);
    for (const auto& file : files)
        if (!file->target.empty()) check_target(file->path, file->target);
    // From here on a signal is too late: files that are new are not undone.
    const SignalShield shield;
    for (std::size_t i = 0; i < files.size(); ++i) {
        Reserved& file = *files[i];
        if (file.target.empty()) continue;
        keep_rights(file.file, file.target);
        if (file.file.rename_to(file.target)) continue;
        std::string reason = std::strerror(errno);
        std::vector<std::string> done, open;
        for (std::size_t k = 0; k < files.size(); ++k) (k < i ? done : open).push_back(files[k]->path);
        if (!done.empty()) reason += "; new are " + listed(done) + "; not written are " + listed(open);
        refuse_name(file.path, reason, "choose another name");
    }
}

} // namespace

void refuse_unwritten(const std::string& path, const std::string& reason) {
    throw Error(Refusal::unwritable, path + ": cannot be written (" + reason + "); is the disk full?");
}

void OutputFile::sweep_once(const std::filesystem::path& folder) {
    if (OutputSet* const set = current_job().outputs) {
        const std::lock_guard lock(set->files_->mutex);
        std::vector<fs::path>& swept = set->files_->swept;
        if (std::find(swept.begin(), swept.end(), folder) != swept.end()) return;
        swept.push_back(folder);
    }
    sweep_temporary_files(folder);
}

OutputFile::OutputFile(const std::string& path) {
    if (const std::string place = number_place(fs::path(path).filename().string()); !place.empty())
        throw Error(Refusal::usage, path + ": " + place +
                                        " stands for the number of a tile or of a frame, but one file "
                                        "is written; write the number itself");
    fs::path target = followed(path);
    check_target(path, target);
    struct stat file {};
    const bool discarded = stat(target.c_str(), &file) == 0 && is_null_device(file);
    std::error_code none;
    const fs::path folder = discarded ? fs::temp_directory_path(none) : target.parent_path();
    if (!discarded) sweep_once(folder);
    TemporaryFile made(folder.string(), discarded);
    if (made.descriptor() < 0) refuse_call(path, "choose a folder that exists and that you may write to");
    if (discarded) target.clear();
    reserved_.reset(new Reserved{path, std::move(target), std::move(made)});
}

OutputFile::~OutputFile() = default;

int OutputFile::open_descriptor() const {
    const int copy = fcntl(reserved_->file.descriptor(), F_DUPFD_CLOEXEC, 0);
    if (copy < 0) refuse_call(reserved_->path, "write fewer files at a time");
    return copy;
}

std::FILE* OutputFile::open_stream() const {
    const int copy = open_descriptor();
    std::FILE* const stream = fdopen(copy, "r+b");
    if (!stream) close(copy);
    if (!stream) refuse_call(reserved_->path, "write fewer files at a time");
    return stream;
}

std::int64_t OutputFile::size() const {
    struct stat file {};
    return fstat(reserved_->file.descriptor(), &file) == 0 ? std::int64_t(file.st_size) : 0;
}

void OutputFile::commit() {
    if (size() == 0) refuse_unwritten(reserved_->path, "it came out empty");
    if (OutputSet* const set = current_job().outputs) {
        const std::lock_guard lock(set->files_->mutex);
        set->files_->written.push_back(std::move(reserved_));
        return;
    }
    std::vector<std::unique_ptr<Reserved>> alone;
    alone.push_back(std::move(reserved_));
    rename_all(std::move(alone));
}

OutputSet::OutputSet() : files_(std::make_unique<Files>()), outer_(current_job().outputs.exchange(this)) {}

OutputSet::~OutputSet() { current_job().outputs = outer_; }

void OutputSet::commit() {
    auto files = std::exchange(files_->written, {});
    if (!outer_) {
        std::vector<std::string> names;
        for (const auto& file : files) names.push_back(file->path);
        rename_all(std::move(files));
        committed_.insert(committed_.end(), names.begin(), names.end());
        return;
    }
    const std::lock_guard lock(outer_->files_->mutex);
    for (auto& file : files) outer_->files_->written.push_back(std::move(file));
}

} // namespace bake
