// The text of a scene file and the places of its tables, for changes that leave all else as it is.
#pragma once
#include "bake/verdict/plan/text_edits.h"
#include <string>
#include <string_view>
#include <toml++/toml.h>
#include <vector>

namespace bake {

/// Tables of a [[list]], in the order of the file.
std::vector<const toml::table*> tables(const toml::table& root, std::string_view key);

/// Where the parser saw a value, or the head of a table.
Span span_of(const TextEdits& edits, const toml::node& node);

/// From the first line of a table to the last line of its values; of an inline table what is within its braces, with them.
Span block_of(const TextEdits& edits, const toml::table& table);

/// Adds a key to a table on the line after the value `behind`, or after it within braces.
void add_key(TextEdits& edits, const toml::table& table, const toml::node& behind, const std::string& line);

/// Gives a key of the table `[section]` a value; adds the key, and the table at the end of the text, if there is none.
void set_key(TextEdits& edits, const toml::table& root, const std::string& section, const std::string& key,
             const std::string& value);

/// Gives a key of a material a value; adds the key after the height, or else after the name.
void set_material_key(TextEdits& edits, const toml::table& material, const std::string& key, const std::string& value);

/// Removes a table of a list, with an empty line that would be doubled.
void remove_table(TextEdits& edits, const toml::table& table);

} // namespace bake
