#include "bake/picture/decoder_program.h"
#include "bake/picture/picture_file.h"
#include <dlfcn.h>
#include <filesystem>
#include <link.h>
#include <unistd.h>

namespace bake {
namespace {

/// The folder of the program or shared library that holds this function; empty when it is unknown.
std::filesystem::path own_folder() {
    Dl_info found;
    link_map* object = nullptr;
    if (!dladdr1(reinterpret_cast<void*>(&own_folder), &found, reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP))
        return {};
    // The program itself has no name in the list of loaded objects.
    std::error_code failed;
    const std::filesystem::path file = *object->l_name ? object->l_name : "/proc/self/exe";
    return std::filesystem::canonical(file, failed).parent_path();
}

} // namespace

std::string decoder_program(const std::string& path) {
    const std::filesystem::path own = own_folder();
    for (const char* folder : {"", BAKE_FORMATS_FROM_PROGRAM, BAKE_FORMATS_FOLDER}) {
        // An absolute folder replaces the one that it is appended to.
        const std::filesystem::path program = (own / folder / "bake_formats").lexically_normal();
        std::error_code failed;
        if (program.is_absolute() && std::filesystem::is_regular_file(program, failed) &&
            access(program.c_str(), X_OK) == 0)
            return program.string();
    }
    throw unreadable(path, "its decoder, the program bake_formats, is missing",
                     ("put it into " + own.string() + " or into " BAKE_FORMATS_FOLDER).c_str());
}

} // namespace bake
