// Atomic output: written beside its target under a temporary name, renamed when complete.
#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace bake {

/// What is written there is discarded; the name has no ending that tells a format.
inline constexpr const char* null_device = "/dev/null";

/// The old file stays as it was until commit(); a destructor without commit() removes the temporary file. A symbolic link
/// is followed, and the file that it names is replaced. The new file has the mode of the old one, and its owner where
/// the system permits. What is written to the null device goes to a temporary file that has no name.
class OutputFile {
public:
    /// Reserves `path`, and removes temporary files that killed runs left in its folder. Throws Error{Refusal::usage} for a
    /// name with the place of a number in it (<UDIM>, %d), which would otherwise be written as it stands, and for a file
    /// that is one of the inputs (see InputRecord); Error{Refusal::unwritable} when its folder is missing or not writable,
    /// or when `path` is there and not a regular file, so that a long bake does not fail at its end.
    explicit OutputFile(const std::string& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// A descriptor of the temporary file for reading and writing, which the caller closes. All such descriptors share one
    /// position. Throws Error{Refusal::unwritable}.
    int open_descriptor() const;
    /// The same as a stream.
    std::FILE* open_stream() const;
    /// Size of what was written.
    std::int64_t size() const;
    /// To be called when every descriptor and stream is closed. Renames the temporary file to the target, or leaves that to
    /// the OutputSet that lives. Throws Error{Refusal::unwritable}, also for an empty file, which no format has, and
    /// Error{Refusal::interrupted}.
    void commit();

    struct Reserved;

private:
    static void sweep_once(const std::filesystem::path& folder);

    std::unique_ptr<Reserved> reserved_;
};

/// Files that appear under their names together: while a set lives, OutputFile::commit() hands over its file to it. A set
/// within another one hands over all its files. From any thread; sets are made and ended by one thread.
class OutputSet {
public:
    OutputSet();
    /// Removes the temporary files of what was not committed.
    ~OutputSet();
    OutputSet(const OutputSet&) = delete;
    OutputSet& operator=(const OutputSet&) = delete;

    /// Renames all files. Throws as OutputFile::commit(), and Error{Refusal::usage} if two have the same name. If a rename
    /// fails after others succeeded, the message says which files are new and which are old. After the call
    /// interrupted() may be true, but everything is written.
    void commit();
    /// The names of the files that commit() renamed so far, as they were given.
    const std::vector<std::string>& committed() const noexcept { return committed_; }

private:
    friend class OutputFile;
    struct Files;
    std::unique_ptr<Files> files_;
    std::vector<std::string> committed_;
    OutputSet* outer_;
};

/// "<path>: cannot be written (<reason>); is the disk full?" as Error{Refusal::unwritable}.
[[noreturn]] void refuse_unwritten(const std::string& path, const std::string& reason);

} // namespace bake
