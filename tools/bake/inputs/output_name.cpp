#include "inputs/output_name.h"
#include "options.h"

namespace bake {

CLI::Option* add_output_option(CLI::App& sub, std::string& out, const std::string& help) {
    return sub.add_option("-o,--out", out, help)->required();
}

} // namespace bake
