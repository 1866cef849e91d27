// The files that a job reads, so that none of them is replaced by an output of the same job.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct stat;

namespace bake {

struct InputFiles;

/// While it lives, every file that the library opens for reading is remembered, and an OutputFile refuses to replace one of
/// them. The command has one for each run; a program that replaces its own inputs on purpose has none. At most one lives
/// at a time in each job (base/job.h).
class InputRecord {
public:
    InputRecord();
    ~InputRecord();
    InputRecord(const InputRecord&) = delete;
    InputRecord& operator=(const InputRecord&) = delete;

private:
    std::unique_ptr<InputFiles> files_;
};

/// Remembers a file that was opened for reading. From any thread; does nothing without an InputRecord.
void remember_input(const std::string& path, const struct stat& file);
/// To be called while its descriptor is open, when all that is read of it has been read: hashes its contents, which are then
/// those that were read, whatever happens to the file later. Does nothing for a file that is not remembered.
void input_was_read(int descriptor);
/// Whether a file, by device and inode, is one of those that were read.
bool is_input(const struct stat& file);

/// What the system says of a file, by which a change is seen without reading it.
struct FileStamp {
    std::int64_t size = -1;
    std::int64_t changed_ns = 0; ///< the time of the last change of its contents
    std::uint64_t number = 0;    ///< of the file in its file system: another one has taken its name if this changes

    bool operator==(const FileStamp&) const = default;
};
FileStamp stamp_of(const struct stat& file) noexcept;
/// Of the file that has this name now; nothing if there is none.
std::optional<FileStamp> stamp_at(const std::string& path);

struct ReadFile {
    std::string path; ///< as it was opened
    FileStamp stamp;  ///< at that time
};
/// The files that were read so far, in any order. Empty without an InputRecord.
std::vector<ReadFile> files_read();

struct InputFile {
    std::string path; ///< as it was opened
    std::string name; ///< without its folder
    std::string hash; ///< file_hash() of what was read; empty if the file was changed while it was read
};
/// The files that were read so far, in the order of their names. Files that are no longer there are left out, as they are
/// temporary ones. Empty without an InputRecord.
std::vector<InputFile> recorded_inputs();

} // namespace bake
