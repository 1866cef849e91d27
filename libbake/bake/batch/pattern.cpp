#include "bake/batch/pattern.h"
#include <algorithm>
#include <filesystem>

namespace bake {
namespace fs = std::filesystem;

namespace {

bool matches_from(const char* pattern, const char* path, bool at_start) {
    for (; *pattern; ++pattern, ++path) {
        if (at_start && *path == '.' && *pattern != '.') return false;
        if (*pattern == '*') {
            while (*pattern == '*') ++pattern;
            for (;; ++path) {
                if (matches_from(pattern, path, false)) return true;
                if (*path == '\0' || *path == '/') return false;
            }
        }
        if (*path == '\0' || (*pattern == '?' ? *path == '/' : *pattern != *path)) return false;
        at_start = *path == '/';
    }
    return *path == '\0';
}

/// Appends what is in `folder` (with a / at its end, or empty) and of the rest of the pattern.
void add_files(const std::string& folder, const std::string& rest, std::vector<std::string>& found) {
    const std::size_t slash = rest.find('/');
    const std::string part = rest.substr(0, slash);
    std::error_code failed;
    const auto add = [&](const std::string& name) {
        const std::string path = folder + name;
        if (slash != std::string::npos) add_files(path + "/", rest.substr(slash + 1), found);
        else if (fs::is_regular_file(path, failed)) found.push_back(path);
    };
    if (!is_pattern(part)) return add(part);
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        std::string name = entry->path().filename().string();
        if (!matches(part, name)) continue;
        if (slash != std::string::npos) add(name);
        else if (entry->is_regular_file(failed)) found.push_back(folder + name); // mostly known without asking for it
    }
}

} // namespace

bool is_pattern(const std::string& path) { return path.find_first_of("*?") != std::string::npos; }

bool matches(const std::string& pattern, const std::string& path) {
    return matches_from(pattern.c_str(), path.c_str(), true);
}

std::vector<std::string> files_of(const std::string& pattern) {
    std::vector<std::string> found;
    add_files("", pattern, found);
    std::sort(found.begin(), found.end());
    return found;
}

std::string stem_of(const std::string& path) { return fs::path(path).stem().string(); }

} // namespace bake
