#include "bake/preview/scene_section.h"
#include "bake/base/error.h"
#include "bake/preview/nearest_key.h"
#include <algorithm>
#include <filesystem>
#include <sstream>

namespace bake {
namespace {

std::string text_of(double v) {
    std::ostringstream out;
    out << v;
    return out.str();
}

double checked_number(const Section& in, const toml::node& node, std::string_view key, double low, double high) {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) refuse(in, node, in_quotes(key) + " is not a number; give one");
    if (!(*value >= low && *value <= high)) // NaN fails too
        refuse(in, node,
               in_quotes(key) + " is " + text_of(*value) + ", outside " + text_of(low) + " to " + text_of(high) +
                   "; give a value in that range");
    return *value;
}

} // namespace

void refuse(const std::string& file, int line, const std::string& why) {
    throw Error(Refusal::unreadable, file + ":" + std::to_string(line) + ": " + why);
}

int line_of(const toml::node& node) { return int(node.source().begin.line); }

void refuse(const Section& in, const toml::node& at, const std::string& why) {
    refuse(in.file, line_of(at), in.name + " " + why);
}

void allow_only(const Section& in, std::initializer_list<std::string_view> keys) {
    for (const auto& [key, node] : in.table) {
        if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
        std::string known;
        for (const std::string_view k : keys) known += (known.empty() ? "" : ", ") + std::string(k);
        const std::string meant = did_you_mean(std::string(key.str()), {keys.begin(), keys.end()});
        const int line = int(key.source().begin.line);
        refuse(in.file, line,
               "unknown key \"" + std::string(key.str()) + "\" in " + in.name + "; " +
                   (meant.empty() ? "known are " + known : meant));
    }
}

std::string in_quotes(std::string_view key) { return "\"" + std::string(key) + "\""; }

void read(const Section& in, std::string_view key, float& value, double low, double high) {
    if (const toml::node* node = in.table.get(key)) value = float(checked_number(in, *node, key, low, high));
}

int checked_integer(const Section& in, const toml::node& node, std::string_view key, int low, int high) {
    if (!node.is_integer()) refuse(in, node, in_quotes(key) + " is not a whole number; give one");
    return int(checked_number(in, node, key, low, high));
}

void read(const Section& in, std::string_view key, int& value, int low, int high) {
    if (const toml::node* node = in.table.get(key)) value = checked_integer(in, *node, key, low, high);
}

void read(const Section& in, std::string_view key, bool& value) {
    const toml::node* node = in.table.get(key);
    if (!node) return;
    if (!node->is_boolean()) refuse(in, *node, in_quotes(key) + " is neither true nor false; give one of them");
    value = *node->value<bool>();
}

bool read(const Section& in, std::string_view key, std::string& value) {
    const toml::node* node = in.table.get(key);
    if (!node) return false;
    if (!node->is_string() || node->as_string()->get().empty())
        refuse(in, *node, in_quotes(key) + " is not a string; give one in quotes");
    value = node->as_string()->get();
    return true;
}

const toml::array& checked_array(const Section& in, const toml::node& node, std::string_view key, std::size_t count,
                                 const char* of_what) {
    const toml::array* list = node.as_array();
    if (!list || list->size() != count)
        refuse(in, node,
               in_quotes(key) + " is not a list of " + std::to_string(count) + " " + of_what + "; give one in [ ]");
    return *list;
}

bool read(const Section& in, std::string_view key, Vec3f& value, double low) {
    const toml::node* node = in.table.get(key);
    if (!node) return false;
    const toml::array& list = checked_array(in, *node, key, 3, "numbers");
    for (int i = 0; i < 3; ++i) value[i] = float(checked_number(in, *list.get(i), key, low, largest_number));
    return true;
}

bool read_triple(const Section& in, std::string_view key, Vec3f& value, double low) {
    const toml::node* node = in.table.get(key);
    if (!node || !node->is_number()) return read(in, key, value, low);
    value = Vec3f(float(checked_number(in, *node, key, low, largest_number)));
    return true;
}

bool read_colour(const Section& in, std::string_view key, Vec3f& value) { return read_triple(in, key, value, 0); }

std::string beside(const std::string& scene_file, const std::string& path) {
    return (std::filesystem::path(scene_file).parent_path() / path).lexically_normal().string();
}

bool read_path(const Section& in, std::string_view key, std::string& value) {
    if (!read(in, key, value)) return false;
    value = beside(in.file, value);
    return true;
}

void read_colour_space(const Section& in, std::string_view key, ColourSpace& value) {
    using enum ColourSpace;
    read_choice<ColourSpace>(in, key, value, {{"auto", automatic}, {"srgb", srgb}, {"linear", linear}});
}

} // namespace bake
