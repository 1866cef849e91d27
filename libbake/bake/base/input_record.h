// The files that a job reads, so that none of them is replaced by an output of the same job.
#pragma once
#include <memory>
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
/// Whether a file, by device and inode, is one of those that were read.
bool is_input(const struct stat& file);

struct InputFile {
    std::string path; ///< as it was opened
    std::string name; ///< without its folder
    std::string hash; ///< file_hash(); empty for a file that is no longer there
};
/// The files that were read so far, in the order of their names. Each is hashed once. Empty without an InputRecord.
std::vector<InputFile> recorded_inputs();

} // namespace bake
