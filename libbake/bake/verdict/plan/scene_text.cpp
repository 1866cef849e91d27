#include "bake/verdict/plan/scene_text.h"
#include <algorithm>

namespace bake {
namespace {

constexpr const char* blanks = " \t\r\n";

/// The comma after `at` with nothing but blanks and comments between; npos if something else comes first.
std::size_t comma_after(std::string_view text, std::size_t at) {
    while ((at = text.find_first_not_of(blanks, at)) != std::string_view::npos && text[at] == '#')
        at = text.find('\n', at);
    return at != std::string_view::npos && text[at] == ',' ? at : std::string_view::npos;
}

/// The begin of the line after `at`, or the end of the text.
std::size_t next_line(std::string_view text, std::size_t at) {
    return std::min(text.find('\n', at), text.size() - 1) + 1;
}

bool is_blank(std::string_view line) { return line.find_first_not_of(blanks) == std::string_view::npos; }

/// The last value of a table that has values and no tables of its own.
const toml::node& last_value(const TextEdits& edits, const toml::table& table) {
    const toml::node* last = nullptr;
    for (auto&& [key, node] : table)
        if (!last || span_of(edits, node).begin > span_of(edits, *last).begin) last = &node;
    return *last;
}

} // namespace

std::vector<const toml::table*> tables(const toml::table& root, std::string_view key) {
    std::vector<const toml::table*> list;
    if (const toml::array* array = root[key].as_array())
        for (const toml::node& node : *array)
            if (const toml::table* table = node.as_table()) list.push_back(table);
    return list;
}

Span span_of(const TextEdits& edits, const toml::node& node) {
    const auto place = [](const toml::source_position& at) { return Place{at.line, at.column}; };
    return {edits.offset(place(node.source().begin)), edits.offset(place(node.source().end))};
}

Span block_of(const TextEdits& edits, const toml::table& table) {
    const Span span = span_of(edits, table);
    if (table.is_inline()) return span;
    std::size_t last = span.end;
    const auto reach = [&](const toml::table& part, const auto& self) -> void {
        for (auto&& [key, node] : part) {
            if (node.is_table() && !node.as_table()->is_inline()) self(*node.as_table(), self);
            else last = std::max(last, span_of(edits, node).end);
        }
    };
    reach(table, reach);
    return {edits.line_begin(span.begin), edits.line_end(last)};
}

void add_key(TextEdits& edits, const toml::table& table, const toml::node& behind, const std::string& line) {
    const Span span = span_of(edits, behind);
    if (table.is_inline()) return edits.insert(span.end, ", " + line);
    const std::size_t begin = edits.line_begin(span.begin);
    const std::size_t key = edits.text().find_first_not_of(" \t", begin);
    const std::string indent(edits.text().substr(begin, key - begin));
    edits.insert(edits.line_end(span.end), edits.newline(span.end) + indent + line);
}

void set_key(TextEdits& edits, const toml::table& root, const std::string& section, const std::string& key,
             const std::string& value) {
    const std::string line = key + " = " + value;
    const toml::table* table = root[section].as_table();
    if (!table) {
        const std::string_view text = edits.text();
        const std::string newline = edits.newline(0);
        const bool ended = text.empty() || text.back() == '\n';
        return edits.insert(text.size(),
                            (ended ? "" : newline) + newline + "[" + section + "]" + newline + line + newline);
    }
    if (const toml::node* old = table->get(key)) return edits.replace(span_of(edits, *old), value);
    const Span span = span_of(edits, *table);
    if (edits.text()[span.begin] == '[')
        return edits.insert(edits.line_end(span.begin), edits.newline(span.begin) + line);
    if (table->empty()) return edits.insert(span.begin + 1, line);
    // What is neither a table with a head nor one within braces is made of keys with dots.
    add_key(edits, *table, last_value(edits, *table), table->is_inline() ? line : section + "." + line);
}

void set_material_key(TextEdits& edits, const toml::table& material, const std::string& key, const std::string& value) {
    if (const toml::node* old = material.get(key)) return edits.replace(span_of(edits, *old), value);
    // A height in a table of its own is no place for a key of the material.
    const toml::node* height = material.get("height");
    const bool one_value = height && (!height->is_table() || height->as_table()->is_inline());
    add_key(edits, material, one_value ? *height : *material.get("name"), key + " = " + value);
}

void remove_table(TextEdits& edits, const toml::table& table) {
    const std::string_view text = edits.text();
    Span block = block_of(edits, table);
    if (table.is_inline()) {
        edits.replace(block, "");
        // A comma may follow the last table of a list.
        if (const std::size_t comma = comma_after(text, block.end); comma != std::string_view::npos)
            edits.replace({comma, comma + 1}, "");
        return;
    }
    block.end = next_line(text, block.end);
    const std::size_t before = block.begin == 0 ? 0 : edits.line_begin(block.begin - 1);
    const std::size_t after = next_line(text, block.end);
    if (block.end < text.size() && is_blank(text.substr(before, block.begin - before)) &&
        is_blank(text.substr(block.end, after - block.end)))
        block.end = after;
    edits.replace(block, "");
}

} // namespace bake
