#include "pages/option_view.h"
#include <algorithm>
#include <sstream>

namespace bake {
namespace {

/// The words of "auto|8|half"; nothing where a part stands for something else, as in "LENGTH|N%".
std::vector<std::string> choices_of(const std::string& value) {
    if (value.find('|') == std::string::npos) return {};
    std::vector<std::string> words;
    std::istringstream in(value);
    for (std::string word; std::getline(in, word, '|');) {
        const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
        if (word.empty() || !std::all_of(word.begin(), word.end(), plain)) return {};
        words.push_back(word);
    }
    return words;
}

/// "OUT.png" and the words that stand for any name.
bool is_file(const std::string& value) {
    for (const char* word : {"TEXT", "MESH", "PREFIX", "FILE", "FOLDER", "PICTURE", "."})
        if (value.find(word) != std::string::npos) return true;
    return false;
}

} // namespace

std::vector<OptionView> options_of(const CLI::App& app) {
    std::vector<OptionView> views;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_group().empty()) continue; // hidden
        OptionView view;
        for (const std::string& name : option->get_snames()) view.names.push_back("-" + name);
        for (const std::string& name : option->get_lnames()) view.names.push_back("--" + name);
        view.positional = !option->nonpositional();
        if (view.positional) view.names = {option->get_name(true)};
        if (option->get_items_expected_max() > 0) view.value = option->get_type_name();
        view.choices = choices_of(view.value);
        view.file = is_file(view.value);
        view.required = option->get_required();
        view.many = option->get_items_expected_max() > 1;
        view.description = option->get_description();
        view.default_value = option->get_default_str();
        for (const CLI::Option* needed : option->get_needs()) view.needs.push_back(needed->get_name());
        std::sort(view.needs.begin(), view.needs.end()); // a set of pointers has no order of its own
        views.push_back(std::move(view));
    }
    return views;
}

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

} // namespace bake
