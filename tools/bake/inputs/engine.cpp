#include "inputs/engine.h"
#include "bake/base/text.h"
#include <bit>
#include <filesystem>

namespace bake {

void add_engine_option(CLI::App& sub, EngineChoice& engine) {
    std::vector<std::string> names;
    for (const ConsumerEntry& known : consumers)
        if (known.normal_map) names.emplace_back(known.name);
    std::string listed;
    for (const std::string& name : names) listed += (listed.empty() ? "" : "|") + name;
    sub.add_option_function<std::string>(
           "--for",
           [&engine](const std::string& name) {
               for (const ConsumerEntry& known : consumers)
                   if (name == known.name) engine = &known;
           },
           "What loads the map: sets green and the depth of a .png, and with -o FOLDER/ the name of the file")
        ->check(CLI::IsMember(names).description(""))
        ->type_name(listed);
}

bool names_folder(const std::string& out) { return out.ends_with('/') || std::filesystem::is_directory(out); }

std::string normal_map_name(const NormalMapRule& rule, const std::string& folder, const std::string& stem) {
    return (std::filesystem::path(folder) / (rule.before + stem + rule.after + ".png")).string();
}

std::string size_note(const NormalMapRule& rule, int width, int height) {
    const bool powers = std::has_single_bit(unsigned(width)) && std::has_single_bit(unsigned(height));
    return powers || !rule.odd_size ? "" : format("%d x %d: ", width, height) + with_flags(rule.odd_size);
}

} // namespace bake
