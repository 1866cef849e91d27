// A [[material]] written in one line: "diffuse=.8,reflect=.2:.3:.4,albedo=wood.png".
#include "bake/base/error.h"
#include "bake/base/parse_double.h"
#include "bake/picture/colour.h"
#include "bake/preview/quick_scene.h"
#include "bake/preview/scene_objects.h"
#include <charconv>
#include <cmath>

namespace bake {
namespace {

using Parts = std::vector<std::string_view>;

Parts split(std::string_view text, char at) {
    Parts parts;
    for (std::size_t end = 0; end != std::string_view::npos; text.remove_prefix(end + 1)) {
        end = text.find(at);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) break;
    }
    return parts;
}

/// Linear colour of "#rrggbb"; empty if the text is none.
std::optional<toml::array> hexadecimal(std::string_view text) {
    unsigned bits = 0;
    if (text.size() != 7 || text[0] != '#') return {};
    const auto read = std::from_chars(text.data() + 1, text.data() + 7, bits, 16);
    if (read.ec != std::errc() || read.ptr != text.data() + 7) return {};
    Image<float> colour(1, 1, 3);
    for (int c = 0; c < 3; ++c) colour.data()[c] = float((bits >> (16 - 8 * c)) & 255) / 255;
    srgb_to_linear(colour);
    return toml::array{double(colour.data()[0]), double(colour.data()[1]), double(colour.data()[2])};
}

std::optional<toml::array> numbers(std::string_view text) {
    toml::array list;
    for (const std::string_view part : split(text, ':')) {
        const auto number = parse_finite(part);
        if (!number) return {};
        list.push_back(*number);
    }
    return list;
}

void insert(toml::table& table, std::string_view key, std::string_view value) {
    if (value == "true" || value == "false") {
        table.insert_or_assign(key, value == "true");
    } else if (const auto colour = hexadecimal(value)) {
        table.insert_or_assign(key, *colour);
    } else if (const auto list = numbers(value); list && list->size() > 1) {
        table.insert_or_assign(key, *list);
    } else if (const auto number = parse_finite(value)) {
        const bool whole = *number == std::floor(*number) && std::abs(*number) < 1e9;
        if (whole) table.insert_or_assign(key, std::int64_t(*number));
        else table.insert_or_assign(key, *number);
    } else {
        table.insert_or_assign(key, std::string(value));
    }
}

} // namespace

MaterialEntry material_of(const std::string& text, const std::string& defaults) {
    const std::string head = "`material` " + text + ": ";
    toml::table table;
    for (const std::string* values : {&defaults, &text}) {
        if (values->empty()) continue;
        for (const std::string_view part : split(*values, ',')) {
            const std::size_t equals = part.find('=');
            const std::string_view key = part.substr(0, equals);
            if (equals == std::string_view::npos || key.empty() || equals + 1 == part.size())
                throw Error(Refusal::usage,
                            head + in_quotes(part) + " is not KEY=VALUE; write such as diffuse=.8,reflect=.2");
            if (key == "name") throw Error(Refusal::usage, head + "a name is of no use here; remove it");
            insert(table, key, part.substr(equals + 1));
        }
    }
    table.insert_or_assign("name", "material");
    SceneEntries scene; // without a file, whose folder paths would be relative to
    try {
        read_material({table, "[[material]]", scene.file}, scene);
    } catch (const Error& error) {
        // The message starts with the place in a file, ":0: ".
        std::string message = error.what();
        constexpr std::string_view in_toml = "give one in [ ]";
        if (message.ends_with(in_toml))
            message.replace(message.size() - in_toml.size(), in_toml.size(), "join them by colons, such as .8:.4:.2");
        throw Error(Refusal::usage, head + message.substr(std::min(message.find(": ") + 2, message.size())));
    }
    MaterialEntry entry = std::move(scene.materials.front());
    entry.line = 0;
    return entry;
}

} // namespace bake
