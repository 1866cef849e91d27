// Temporary files that survive no run: removed by their owner, by a second signal, or by the next run in their folder.
#pragma once
#include <filesystem>
#include <string>

namespace bake {

/// Removes the temporary files that killed runs left in a folder: those that nobody has locked.
void sweep_temporary_files(const std::filesystem::path& folder);

/// An empty file of a random name in a folder, locked as long as it is open.
class TemporaryFile {
public:
    /// `folder`: empty for the working directory. `nameless`: without a name in any folder. descriptor() is -1, and errno
    /// set, when the file cannot be made.
    explicit TemporaryFile(const std::string& folder, bool nameless = false);
    /// Closes and removes the file.
    ~TemporaryFile();
    TemporaryFile(TemporaryFile&& from) noexcept;
    TemporaryFile& operator=(TemporaryFile&&) = delete;

    int descriptor() const noexcept { return descriptor_; }
    /// Gives the file a lasting name. Returns whether that succeeded, with errno set.
    bool rename_to(const std::filesystem::path& target) noexcept;

private:
    std::string path_;
    int descriptor_ = -1, slot_ = -1;
};

} // namespace bake
