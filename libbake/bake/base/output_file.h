// Atomic output: written beside its target under a temporary name, renamed when complete.
#pragma once
#include <string>

namespace bake {

/// The old file stays as it was until commit(); a destructor without commit() removes the temporary file.
class OutputFile {
public:
    /// Reserves `path`. Throws Error{Refusal::usage} for a name with the place of a number in it (<UDIM>, %d), which would
    /// otherwise be written as it stands, and Error{Refusal::unwritable} when its folder is missing or not writable, or when `path`
    /// is a folder, so that a long bake does not fail at its end.
    explicit OutputFile(std::string path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Where to write. The name has the target's ending.
    const std::string& temporary() const noexcept { return temporary_; }
    /// Renames the closed temporary file to the target. Throws Error{Refusal::unwritable}.
    void commit();

private:
    std::string path_, temporary_;
    bool committed_ = false;
};

/// Writes `text` to `path` atomically. Throws Error{Refusal::unwritable}.
void write_text(const std::string& path, const std::string& text);

} // namespace bake
