#include "bake/verdict/plan/folder_from.h"

namespace bake {

std::filesystem::path folder_from(const std::string& from, const std::string& to) {
    namespace fs = std::filesystem;
    const auto folder = [](const std::string& file) {
        const fs::path parent = fs::path(file).parent_path();
        return fs::absolute(parent.empty() ? fs::path(".") : parent).lexically_normal() / "";
    };
    const fs::path source = folder(from), real = fs::weakly_canonical(folder(to)) / "";
    if (fs::weakly_canonical(source) / "" == real) return ".";
    // The way up leads through folders and never through links, whose parent another name has; the way down may be by links.
    return source.lexically_relative(real);
}

} // namespace bake
