// The list of bakes as TOML.
#include "bake/base/printable.h"
#include "bake/verdict/plan/manifest.h"
#include "bake/verdict/plan/toml_string.h"

namespace bake {
namespace {

std::string list_of(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + toml_string(word);
    return "[" + text + "]";
}

std::string table_of(const Bake::Values& values) {
    std::string text;
    for (const auto& [option, value] : values)
        text += (text.empty() ? "" : ", ") + option + " = " + (value.empty() ? "true" : toml_string(value));
    return "{" + text + "}";
}

std::string text_of(const Bake& bake) {
    std::string text = "\n[[bake]]\nname = " + toml_string(bake.name) + "\nverb = " + toml_string(bake.verb) + "\n";
    if (!bake.files.empty()) text += "files = " + list_of(bake.files) + "\n";
    if (!bake.inputs.empty()) text += "inputs = " + table_of(bake.inputs) + "\n";
    if (!bake.options.empty()) text += "options = " + table_of(bake.options) + "\n";
    text += "outputs = " + table_of(bake.outputs) + "\n";
    if (!bake.after.empty()) text += "after = " + list_of(bake.after) + "\n";
    std::string tiles;
    for (const int tile : bake.tiles) tiles += (tiles.empty() ? "" : ", ") + std::to_string(tile);
    if (!tiles.empty()) text += "tiles = [" + tiles + "]\n";
    if (!bake.objects.empty()) text += "objects = " + list_of(bake.objects) + "\n";
    if (!bake.use.empty()) text += "use = " + toml_string(bake.use) + "\n";
    return text;
}

} // namespace

std::string to_toml(const Manifest& manifest) {
    std::string text =
        "# Bakes of a planned scene; paths are relative to this file. docs/manifest.md describes the keys.\n"
        "manifest = 1\n";
    for (const std::string& note : manifest.notes) text += "# " + printable(note) + "\n";
    for (const Bake& bake : manifest.bakes) text += text_of(bake);
    return text;
}

} // namespace bake
