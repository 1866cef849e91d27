#include "bake/preview/scene_relief.h"
#include "bake/base/parse_double.h"

namespace bake {
namespace {

/// A number in object units, or "2%" of the diagonal of the mesh.
void read_amplitude(const Section& in, ReliefEntry& relief) {
    const toml::node* node = in.table.get("amplitude");
    if (!node) return;
    float value = 0;
    if (const auto* text = node->as_string()) {
        const std::string& word = text->get();
        const auto percent =
            word.ends_with('%') ? parse_finite(std::string_view(word).substr(0, word.size() - 1)) : std::nullopt;
        if (!percent || std::abs(*percent) > 1e6)
            refuse(in, *node, "\"amplitude\" is " + in_quotes(word) + "; give a number, or a per cent such as \"2%\"");
        value = float(*percent / 100);
        relief.relative = true;
    } else {
        read(in, "amplitude", value);
    }
    relief.amplitude = value;
}

} // namespace

void read_relief(const Section& in, ReliefEntry& relief) {
    const toml::node* node = in.table.get("height");
    if (node && node->is_string()) {
        read_path(in, "height", relief.file);
    } else if (node) {
        const toml::table* table = node->as_table();
        if (!table)
            refuse(in, *node, "\"height\" is neither a file nor such as {file = \"bricks.png\", amplitude = 0.05}");
        const Section height{*table, in.name + " height", in.file};
        allow_only(height, {"file", "amplitude", "midlevel", "filter", "wrap"});
        if (!read_path(height, "file", relief.file))
            refuse(height, *node, "\"file\" is missing; give a height picture");
        read_amplitude(height, relief);
        if (float midlevel = 0; table->get("midlevel")) read(height, "midlevel", midlevel), relief.midlevel = midlevel;
        std::vector<std::pair<std::string_view, Filter>> filters = {{"auto", Filter::automatic}};
        for (const Filter filter : all_filters) filters.emplace_back(name(filter), filter);
        read_choice<Filter>(height, "filter", relief.filter, std::span(filters));
        read_choice<Wrap>(height, "wrap", relief.wrap,
                          {{"repeat", Wrap::repeat}, {"clamp", Wrap::clamp}, {"mirror", Wrap::mirror}});
    }
    std::string shade;
    if (!read(in, "shade", shade)) return;
    relief.shade = parse_shade(shade);
    if (!relief.shade)
        refuse(in, *in.table.get("shade"), "\"shade\" is " + in_quotes(shade) + "; give one of " + shade_names);
}

} // namespace bake
