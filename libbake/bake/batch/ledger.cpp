#include "bake/batch/ledger.h"
#include "bake/base/content_hash.h"
#include <algorithm>

namespace bake {
namespace {

std::string key_of(const BatchTask& task) {
    std::string text;
    for (const std::string& word : task.words) text += '\0' + word;
    return content_hash(text.data(), text.size());
}

} // namespace

std::optional<FileStamp> Ledger::stamp_now(const std::string& path) {
    const auto [known, fresh] = stamps_.try_emplace(path);
    if (fresh) known->second = stamp_at(path);
    return known->second;
}

bool Ledger::is_unchanged(FileMark& mark) {
    const std::optional<FileStamp> now = stamp_now(mark.path);
    if (!now || mark.hash.empty()) return false;
    if (*now == mark.stamp) return true;
    if (now->size != mark.stamp.size) return false;
    FileMark& hashed = hashed_[mark.path];
    if (hashed.stamp != *now) hashed = {mark.path, *now, file_hash(mark.path).value_or("")};
    if (hashed.hash != mark.hash) return false;
    mark.stamp = *now; // touched, or copied: the next run need not read it
    changed_ = true;
    return true;
}

std::string Ledger::why(const BatchTask& task) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(task.name);
    if (found == entries_.end()) return "new";
    LedgerEntry& entry = found->second;
    if (entry.program != program_) return "another version of bake";
    if (entry.key != key_of(task)) return "options changed";
    std::string changed;
    for (FileMark& mark : entry.inputs)
        if (!is_unchanged(mark)) changed += (changed.empty() ? "inputs changed: " : ", ") + mark.path;
    if (!changed.empty()) return changed;
    for (FileMark& mark : entry.outputs) {
        if (!stamp_now(mark.path)) return "output missing: " + mark.path;
        if (!is_unchanged(mark)) return "output changed: " + mark.path;
    }
    return "";
}

std::optional<double> Ledger::seconds(const BatchTask& task) const {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(task.name);
    return found == entries_.end() ? std::nullopt : std::optional(found->second.seconds);
}

/// `before`: what the file was when it was read; if it is another one by now, what was read is not known.
FileMark Ledger::mark_of(const std::string& path, std::optional<FileStamp> before) {
    const std::optional<FileStamp> now = stamp_at(path);
    if (!now || (before && *before != *now)) return {path, before.value_or(FileStamp()), ""};
    {
        const std::lock_guard lock(mutex_);
        if (const auto known = hashed_.find(path); known != hashed_.end() && known->second.stamp == *now)
            return known->second;
    }
    FileMark mark{path, *now, file_hash(path).value_or("")};
    if (stamp_at(path) != now) mark.hash.clear();
    const std::lock_guard lock(mutex_);
    return hashed_[path] = mark;
}

void Ledger::record(const BatchTask& task, const std::vector<ReadFile>& read, const std::vector<std::string>& written,
                    double seconds) {
    LedgerEntry entry{program_, key_of(task), seconds, {}, {}};
    for (const ReadFile& file : read) entry.inputs.push_back(mark_of(file.path, file.stamp));
    for (const std::string& path : written) entry.outputs.push_back(mark_of(path, {}));
    const auto by_path = [](const FileMark& a, const FileMark& b) { return a.path < b.path; };
    std::sort(entry.inputs.begin(), entry.inputs.end(), by_path);
    std::sort(entry.outputs.begin(), entry.outputs.end(), by_path);
    const std::lock_guard lock(mutex_);
    for (const std::string& path : written) stamps_.erase(path);
    entries_[task.name] = std::move(entry);
    changed_ = true;
}

void Ledger::forget(const BatchTask& task) {
    const std::lock_guard lock(mutex_);
    changed_ |= entries_.erase(task.name) > 0;
}

} // namespace bake
