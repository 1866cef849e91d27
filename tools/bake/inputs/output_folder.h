// A folder that a verb writes several files into.
#pragma once
#include <string>

namespace bake {

/// The folder is made if it is not there, and removed again if nothing comes into it.
class OutputFolder {
public:
    /// An empty path is no folder. Throws Error{Refusal::unwritable} if there is no folder and none can be made.
    explicit OutputFolder(const std::string& path);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    explicit operator bool() const noexcept { return !path_.empty(); }
    std::string file(const std::string& name) const;

private:
    std::string path_;
    bool made_ = false;
};

} // namespace bake
