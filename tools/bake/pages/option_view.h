// The options of a verb as manual pages and completions show them.
#pragma once
#include "verb.h"
#include <vector>

namespace bake {

struct OptionView {
    std::vector<std::string> names; ///< "-o" and "--out"; for a positional the word of the help
    bool positional = false;
    std::string value;                ///< what stands for the value in the help; empty for a flag
    std::vector<std::string> choices; ///< if the value is one of a few words
    bool file = false;                ///< the value is or begins with the name of a file
    bool required = false, many = false; ///< many: several values may follow
    std::string description, default_value;
    std::vector<std::string> needs; ///< options without which this one is refused
};

/// In the order of the help.
std::vector<OptionView> options_of(const CLI::App& app);
/// The verbs, in the order of the help.
std::vector<const CLI::App*> verbs_of(const CLI::App& app);

} // namespace bake
