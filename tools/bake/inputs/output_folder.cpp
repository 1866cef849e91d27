#include "inputs/output_folder.h"
#include "bake/base/error.h"
#include <filesystem>

namespace bake {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(const std::string& path) : path_(path) {
    if (path.empty() || fs::is_directory(path)) return;
    std::error_code error;
    made_ = fs::create_directory(fs::path(path).has_filename() ? fs::path(path) : fs::path(path).parent_path(), error);
    if (!made_)
        throw Error(Refusal::unwritable, path + ": is no folder and cannot be made (" + error.message() +
                                             "); make the folder, or give another one");
}

OutputFolder::~OutputFolder() {
    std::error_code error;
    if (made_) fs::remove(path_, error); // fails where files are in it
}

std::string OutputFolder::file(const std::string& name) const { return (fs::path(path_) / name).string(); }

} // namespace bake
