#include "inputs/output_name.h"
#include "options.h"
#include <filesystem>

namespace bake {

CLI::Option* add_output_option(CLI::App& sub, std::string& out, const std::string& help) {
    return sub.add_option("-o,--out", out, help)->required()->check(not_empty());
}

void check_not_input(const std::string& out, const std::string& input) {
    std::error_code absent;
    if (std::filesystem::equivalent(out, input, absent))
        throw Error(Refusal::usage, "--out " + out + ": would replace the file it is made from; choose another name");
}

} // namespace bake
