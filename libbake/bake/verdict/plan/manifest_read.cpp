// The list of bakes from TOML.
#include "bake/base/error.h"
#include "bake/preview/nearest_key.h"
#include "bake/verdict/plan/manifest.h"
#include <algorithm>
#include <initializer_list>
#include <sstream>
#include <string_view>
#include <toml++/toml.h>
#include <unordered_set>

namespace bake {
namespace {

struct Reader {
    const std::string& file;

    [[noreturn]] void refuse(const toml::source_position& at, const std::string& why) const {
        throw Error(Refusal::unreadable, file + ":" + std::to_string(at.line) + ": " + why);
    }
    [[noreturn]] void refuse(const toml::node& at, const std::string& why) const { refuse(at.source().begin, why); }

    static std::string mend(const toml::key& key, std::initializer_list<std::string_view> keys) {
        const std::string meant = did_you_mean(std::string(key.str()), {keys.begin(), keys.end()});
        return meant.empty() ? "remove it" : meant;
    }

    void allow_only(const toml::table& table, std::initializer_list<std::string_view> keys) const {
        for (auto&& [key, node] : table)
            if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
                refuse(key.source().begin,
                       "\"" + std::string(key.str()) + "\" is not a key of a manifest; " + mend(key, keys));
    }

    std::string text(const toml::node& node, const char* key) const {
        const auto* value = node.as_string();
        if (!value || value->get().empty())
            refuse(node, "\"" + std::string(key) + "\" is not a string; give one in quotes");
        return value->get();
    }

    /// An absent key is an empty list.
    std::vector<std::string> list(const toml::table& table, const char* key) const {
        std::vector<std::string> words;
        const toml::node* node = table.get(key);
        if (!node) return words;
        const toml::array* array = node->as_array();
        if (!array) refuse(*node, "\"" + std::string(key) + "\" is not a list; write it in [ ]");
        for (const toml::node& one : *array) words.push_back(text(one, key));
        return words;
    }

    std::vector<int> tiles(const toml::table& table) const {
        std::vector<int> numbers;
        const toml::node* node = table.get("tiles");
        const toml::array* array = node ? node->as_array() : nullptr;
        for (std::size_t i = 0; array && i < array->size(); ++i) {
            const auto number = array->get(i)->value<std::int64_t>();
            if (!array->get(i)->is_integer() || *number < 1001 || *number > 9999)
                refuse(*array->get(i), "\"tiles\" are UDIM numbers, 1001 to 9999; correct this one");
            numbers.push_back(int(*number));
        }
        if (node && numbers.empty()) refuse(*node, "\"tiles\" is no list of numbers; write it as [1001, 1002]");
        return numbers;
    }

    std::string value(const toml::node& node, const char* key) const {
        if (const auto* flag = node.as_boolean(); flag && flag->get()) return "";
        if (!node.is_number()) return text(node, key);
        std::ostringstream out;
        out.imbue(std::locale::classic());
        if (const auto* whole = node.as_integer()) out << whole->get();
        else out.precision(17), out << node.as_floating_point()->get();
        return out.str();
    }

    /// In the order of the file.
    Bake::Values values(const toml::table& table, const char* key, bool paths) const {
        const toml::node* node = table.get(key);
        if (!node) return {};
        const toml::table* inner = node->as_table();
        if (!inner) refuse(*node, "\"" + std::string(key) + "\" is not a table; write it as {option = \"value\"}");
        std::vector<std::pair<toml::source_position, std::pair<std::string, std::string>>> found;
        for (auto&& [option, one] : *inner) {
            const std::string name(option.str());
            if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") != std::string::npos || name[0] == '-')
                refuse(option.source().begin, "\"" + name + "\" is not the name of an option; write it without --");
            found.push_back(
                {option.source().begin, {name, paths ? text(one, name.c_str()) : value(one, name.c_str())}});
        }
        std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
            return std::pair(a.first.line, a.first.column) < std::pair(b.first.line, b.first.column);
        });
        Bake::Values values;
        for (auto& one : found) values.push_back(std::move(one.second));
        return values;
    }

    /// `known`: the names of the bakes before.
    Bake bake(const toml::table& table, std::unordered_set<std::string>& known) const;
};

Bake Reader::bake(const toml::table& table, std::unordered_set<std::string>& known) const {
    allow_only(table, {"name", "verb", "files", "inputs", "options", "outputs", "after", "tiles", "objects", "use"});
    Bake bake;
    for (const char* key : {"name", "verb"})
        if (!table.get(key)) refuse(table, "[[bake]] has no \"" + std::string(key) + "\"; give one");
    bake.name = text(*table.get("name"), "name");
    bake.verb = text(*table.get("verb"), "verb");
    bake.files = list(table, "files");
    bake.inputs = values(table, "inputs", true);
    bake.options = values(table, "options", false);
    bake.outputs = values(table, "outputs", true);
    bake.after = list(table, "after");
    bake.tiles = tiles(table);
    bake.objects = list(table, "objects");
    if (const toml::node* use = table.get("use")) bake.use = text(*use, "use");
    if (bake.outputs.empty()) refuse(table, "[[bake]] has no \"outputs\"; give such as {out = \"normal.png\"}");
    for (const std::string& name : bake.after)
        if (!known.contains(name))
            refuse(*table.get("after"), "\"after\" names \"" + name + "\", which is no earlier bake; put it in front");
    if (!known.insert(bake.name).second)
        refuse(*table.get("name"), "\"name\" \"" + bake.name + "\" is used already; choose another");
    return bake;
}

} // namespace

Manifest parse_manifest(const std::string& text, const std::string& file) {
    const Reader reader{file};
    toml::table root;
    try {
        root = toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        std::string why(error.description());
        std::replace_if(
            why.begin(), why.end(), [](unsigned char c) { return c < 32; }, ' ');
        reader.refuse(error.source().begin, why + "; correct this line");
    }
    const toml::node* version = root.get("manifest");
    if (!version) reader.refuse(toml::source_position{1, 1}, "is no manifest; begin it with manifest = 1");
    if (version->value<std::int64_t>() != 1 || !version->is_integer())
        reader.refuse(*version, "\"manifest\" is not 1, the only version that this program knows");
    reader.allow_only(root, {"manifest", "bake"});
    Manifest manifest;
    std::unordered_set<std::string> known;
    const toml::node* list = root.get("bake");
    if (list && !list->as_array()) reader.refuse(*list, "\"bake\" is a list of tables; write it as [[bake]]");
    for (std::size_t i = 0; list && i < list->as_array()->size(); ++i) {
        const toml::node& one = *list->as_array()->get(i);
        if (!one.is_table()) reader.refuse(one, "\"bake\" is a list of tables; write it as [[bake]]");
        manifest.bakes.push_back(reader.bake(*one.as_table(), known));
    }
    return manifest;
}

} // namespace bake
