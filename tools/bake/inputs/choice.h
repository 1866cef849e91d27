// Options whose value is one of a few names.
#pragma once
#include "verb.h"
#include <utility>
#include <vector>

namespace bake {

/// Accepts these names alone. The help does not list them a second time after the type's name.
CLI::Validator one_of(const std::vector<std::string>& names);

/// Adds an option whose value is one of a few names, and writes the value that belongs to the name. The help shows the
/// name of the present value as the default; a std::optional without a value has none. The last `aliases` choices are
/// accepted, but not shown.
template <class Value>
CLI::Option* add_choice(CLI::App& sub, const std::string& flag, Value& value,
                        std::vector<std::pair<std::string, Value>> choices, const std::string& help,
                        std::size_t aliases = 0) {
    std::vector<std::string> names;
    std::string shown, current;
    for (const auto& [name, choice] : choices) {
        names.push_back(name);
        if (names.size() + aliases > choices.size()) continue;
        shown += (shown.empty() ? "" : "|") + name;
        if (choice == value) current = name;
    }
    const auto set = [&value, choices](const std::string& name) {
        for (const auto& [known, choice] : choices)
            if (known == name) value = choice;
    };
    return sub.add_option_function<std::string>(flag, set, help)
        ->check(one_of(names))
        ->type_name(shown)
        ->default_str(current);
}

} // namespace bake
