// What the tasks of earlier runs read and wrote: the file of state beside a manifest.
#pragma once
#include "bake/base/input_record.h"
#include "bake/batch/task.h"
#include <map>
#include <mutex>
#include <optional>
#include <unordered_map>

namespace bake {

/// A file as a task met it.
struct FileMark {
    std::string path;
    FileStamp stamp;
    std::string hash; ///< content_hash(); empty: the file changed while the task ran, and equals no other
};

struct LedgerEntry {
    std::string program; ///< that ran it
    std::string key;     ///< of the task's command
    double seconds = 0;
    std::vector<FileMark> inputs, outputs;
};

/// From any thread.
class Ledger {
public:
    /// Reads what write() wrote, if `path` is there. `program`: version of the program, whose other versions made other
    /// files. A file that is no ledger of this format counts as absent.
    Ledger(std::string path, std::string program);

    /// Why a task is to run: "new", "another version of bake", "options changed", "inputs changed: a.png", "output changed:
    /// b.png" or "output missing: b.png". Empty if it would write what is there. A file whose stamp is as it was counts
    /// as unchanged, other files are hashed, each once.
    std::string why(const BatchTask& task);
    /// Seconds that the task took when it last ran; nothing if it never did.
    std::optional<double> seconds(const BatchTask& task) const;

    /// Records a task that is done.
    void record(const BatchTask& task, const std::vector<ReadFile>& read, const std::vector<std::string>& written,
                double seconds);
    /// Forgets a task that failed.
    void forget(const BatchTask& task);
    /// Writes the file if something changed. Throws Error{Refusal::unwritable}.
    void write();

private:
    std::optional<FileStamp> stamp_now(const std::string& path);
    bool is_unchanged(FileMark& mark);
    FileMark mark_of(const std::string& path, std::optional<FileStamp> before);
    void read();

    std::string path_, program_;
    mutable std::mutex mutex_;
    std::unordered_map<std::string, LedgerEntry> entries_;
    std::unordered_map<std::string, std::optional<FileStamp>> stamps_; ///< of this run
    std::unordered_map<std::string, FileMark> hashed_;                 ///< in this run
    bool changed_ = false;
};

} // namespace bake
