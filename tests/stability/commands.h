// Runs the command for sweeps, in a folder that is removed at the end.
#pragma once
#include <string>

namespace stability {

class CommandFolder {
public:
    CommandFolder();
    ~CommandFolder();
    CommandFolder(const CommandFolder&) = delete;
    CommandFolder& operator=(const CommandFolder&) = delete;
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }

    void write(const std::string& name, const std::string& text) const;
    /// Bytes of a file; empty if there is none.
    std::string bytes(const std::string& name) const;

    struct Answer {
        int code = -1;
        std::string out, err;
    };
    /// Runs $BAKE with arguments, which a shell reads, in the folder.
    Answer run(const std::string& arguments) const;

private:
    std::string path_;
};

} // namespace stability
