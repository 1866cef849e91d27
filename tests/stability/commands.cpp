#include "stability/commands.h"
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/wait.h>

namespace stability {

CommandFolder::CommandFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "bake_sweep_XXXXXX").string();
    if (mkdtemp(pattern.data())) path_ = pattern;
}

CommandFolder::~CommandFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

void CommandFolder::write(const std::string& name, const std::string& text) const {
    std::ofstream(*this / name, std::ios::binary) << text;
}

std::string CommandFolder::bytes(const std::string& name) const {
    std::ifstream in(*this / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

CommandFolder::Answer CommandFolder::run(const std::string& arguments) const {
    const char* bake = std::getenv("BAKE");
    if (!bake || path_.empty()) return {};
    const std::string command =
        "cd '" + path_ + "' && '" + std::string(bake) + "' " + arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), bytes("stdout.txt"), bytes("stderr.txt")};
}

} // namespace stability
