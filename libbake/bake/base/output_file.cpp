#include "bake/base/output_file.h"
#include "bake/base/error.h"
#include "bake/base/progress.h"
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

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

} // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
    if (const std::string place = number_place(fs::path(path_).filename().string()); !place.empty())
        throw Error(Refusal::usage, path_ + ": " + place +
                                        " stands for the number of a tile or of a frame, but one file "
                                        "is written; write the number itself");
    const fs::path target(path_);
    std::error_code ignored;
    if (path_.empty() || target.filename().empty() || fs::is_directory(target, ignored))
        throw Error(Refusal::unwritable, path_ + ": is a folder; name a file in it");
    std::string name = ".";
    name += target.stem().string() + ".tmp" + std::to_string(getpid()) + target.extension().string();
    temporary_ = (target.parent_path() / name).string();
    const int file = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
        throw Error(Refusal::unwritable, path_ + ": cannot be written (" + std::strerror(errno) +
                                             "); choose a folder that exists and that you may write to");
    close(file);
    remove_on_second_signal(temporary_);
}

OutputFile::~OutputFile() {
    if (committed_) return;
    unlink(temporary_.c_str());
    remove_on_second_signal("");
}

void OutputFile::commit() {
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
        throw Error(Refusal::unwritable,
                    path_ + ": cannot be written (" + std::strerror(errno) + "); choose another name");
    committed_ = true;
    remove_on_second_signal("");
}

void write_text(const std::string& path, const std::string& text) {
    OutputFile file(path);
    std::FILE* out = std::fopen(file.temporary().c_str(), "wb");
    const bool written = out && std::fwrite(text.data(), 1, text.size(), out) == text.size();
    const bool closed = out && std::fclose(out) == 0;
    if (!written || !closed)
        throw Error(Refusal::unwritable,
                    path + ": cannot be written (" + std::strerror(errno) + "); is the disk full?");
    file.commit();
}

} // namespace bake
