#include "inputs/depth_option.h"
#include "inputs/choice.h"

namespace bake {

CLI::Option* add_depth_option(CLI::App& sub, Depth& depth, const std::string& help, bool eight_bits) {
    std::vector<std::pair<std::string, Depth>> choices = {{"auto", Depth::automatic}};
    if (eight_bits) choices.emplace_back("8", Depth::u8);
    choices.insert(choices.end(), {{"16", Depth::u16}, {"half", Depth::half}, {"float", Depth::float32}});
    return add_choice(sub, "--depth", depth, choices, help);
}

Depth resolve_display_depth(const std::string& out, Depth depth) {
    const Depth resolved = resolve_depth(out, depth);
    return depth == Depth::automatic && resolved == Depth::u16 ? Depth::u8 : resolved;
}

} // namespace bake
