#include "bake/verdict/plan/folder_from.h"

namespace bake {

std::filesystem::path folder_from(const std::string& from, const std::string& to) {
    const auto folder = [](const std::string& file) {
        const std::filesystem::path parent = std::filesystem::path(file).parent_path();
        return std::filesystem::weakly_canonical(parent.empty() ? std::filesystem::path(".") : parent);
    };
    return folder(from).lexically_relative(folder(to));
}

} // namespace bake
