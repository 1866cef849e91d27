// A table of a scene file, and typed access to its keys. Internal to this room.
#pragma once
#include "bake/base/vec.h"
#include "bake/environment/file/radiance.h"
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <toml++/toml.h>
#include <utility>

namespace bake {

/// Bound of numbers in a scene, so that squares and products of two numbers are in the range of float.
inline constexpr double largest_number = 1e15;

/// A table with the names for its messages.
struct Section {
    const toml::table& table;
    std::string name; ///< as in the file: [camera], [[mesh]]
    const std::string& file;
};

int line_of(const toml::node& node);
std::string in_quotes(std::string_view key);

/// Throw Error{Refusal::unreadable} with file and line.
[[noreturn]] void refuse(const std::string& file, int line, const std::string& why);
[[noreturn]] void refuse(const Section& in, const toml::node& at, const std::string& why);
/// Refuses all other keys.
void allow_only(const Section& in, std::initializer_list<std::string_view> keys);

int checked_integer(const Section& in, const toml::node& node, std::string_view key, int low, int high);
const toml::array& checked_array(const Section& in, const toml::node& node, std::string_view key, std::size_t count,
                                 const char* of_what);

/// These functions set `value` if the key exists, and refuse a wrong type or a value out of range. The functions that return
/// bool return whether the key exists.
void read(const Section& in, std::string_view key, float& value, double low = -largest_number,
          double high = largest_number);
void read(const Section& in, std::string_view key, int& value, int low, int high);
void read(const Section& in, std::string_view key, bool& value);
bool read(const Section& in, std::string_view key, std::string& value);
bool read(const Section& in, std::string_view key, Vec3f& value, double low = -largest_number);
/// Three numbers, or one number for all three.
bool read_triple(const Section& in, std::string_view key, Vec3f& value, double low);
bool read_colour(const Section& in, std::string_view key, Vec3f& value);
/// A path, relative to the folder of the scene file.
bool read_path(const Section& in, std::string_view key, std::string& value);
std::string beside(const std::string& scene_file, const std::string& path);
void read_colour_space(const Section& in, std::string_view key, ColourSpace& value);

template <class Value>
void read_choice(const Section& in, std::string_view key, Value& value,
                 std::span<const std::pair<std::string_view, Value>> choices) {
    std::string word;
    if (!read(in, key, word)) return;
    std::string known;
    for (const auto& [name, meaning] : choices) {
        if (name == word) {
            value = meaning;
            return;
        }
        known += (known.empty() ? "" : ", ") + in_quotes(name);
    }
    refuse(in, *in.table.get(key), in_quotes(key) + " is " + in_quotes(word) + "; give one of " + known);
}
template <class Value>
void read_choice(const Section& in, std::string_view key, Value& value,
                 std::initializer_list<std::pair<std::string_view, Value>> choices) {
    read_choice<Value>(in, key, value, std::span(choices.begin(), choices.size()));
}

} // namespace bake
