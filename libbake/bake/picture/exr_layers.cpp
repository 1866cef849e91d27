#include "bake/picture/exr_layers.h"
#include <algorithm>
#include <cctype>
#include <iterator>
#include <string_view>

namespace bake {
namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

std::string layer_of(const std::string& channel) {
    const std::size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot);
}

std::string name_of(const std::string& channel) { return channel.substr(channel.rfind('.') + 1); }

constexpr std::string_view ranked[] = {"r",     "red", "g",  "green", "b",  "blue", "y",  "real", "imag",  "a",
                                       "alpha", "ar",  "ra", "ag",    "ga", "ab",   "ba", "z",    "depth", "zback"};
constexpr int unranked = int(std::size(ranked));

/// Where a channel of this name stands among the others. Names that say nothing come last.
int rank(const std::string& channel) {
    return int(std::find(std::begin(ranked), std::end(ranked), lower(name_of(channel))) - std::begin(ranked));
}

struct Layer {
    std::string name;
    std::vector<std::string> channels = {};

    /// The whole name of the channel with one of two names; empty without it.
    std::string find(const char* name_, const char* other) const {
        for (const std::string& channel : channels)
            if (const std::string base = lower(name_of(channel)); base == name_ || base == other) return channel;
        return {};
    }
    std::vector<std::string> colours() const {
        const std::string r = find("r", "red"), g = find("g", "green"), b = find("b", "blue");
        const std::string x = find("x", "x"), y = find("y", "y"), z = find("z", "z");
        if (!r.empty() && !g.empty() && !b.empty()) return {r, g, b};
        if (!x.empty() && !y.empty() && !z.empty()) return {x, y, z};
        if (!y.empty()) return {y};
        if (!r.empty() && !g.empty()) return {r, g};
        if (!r.empty()) return {r};
        return {};
    }
    std::string alpha() const { return find("a", "alpha"); }
};

std::vector<Layer> layers_of(const std::vector<std::string>& channels) {
    std::vector<Layer> layers;
    for (const std::string& channel : channels) {
        const std::string name = layer_of(channel);
        auto at = std::find_if(layers.begin(), layers.end(), [&](const Layer& layer) { return layer.name == name; });
        if (at == layers.end()) at = layers.insert(layers.end(), Layer{name});
        at->channels.push_back(channel);
    }
    return layers;
}

const Layer* main_layer(const std::vector<Layer>& layers) {
    const auto first = [&](auto&& fits) {
        const auto at = std::find_if(layers.begin(), layers.end(), fits);
        return at == layers.end() ? nullptr : &*at;
    };
    if (const Layer* found = first([](const Layer& l) { return l.name.empty() && !l.colours().empty(); })) return found;
    if (const Layer* found = first([](const Layer& l) { return is_main_layer(l.name) && !l.colours().empty(); }))
        return found;
    if (const Layer* found = first([](const Layer& l) {
            const auto colours = l.colours();
            return colours.size() == 3 && rank(colours[0]) <= rank("red");
        }))
        return found;
    return first([](const Layer& l) { return !l.colours().empty(); });
}

/// Channels whose names say nothing, such as the sign of a tangent, belong to the picture if it has at most four in all.
void add_data(const Layer& layer, std::vector<std::string>& channels) {
    std::vector<std::string> data;
    for (const std::string& channel : layer.channels)
        if (rank(channel) == unranked && std::find(channels.begin(), channels.end(), channel) == channels.end())
            data.push_back(channel);
    if (channels.size() + data.size() <= 4) channels.insert(channels.end(), data.begin(), data.end());
}

} // namespace

bool is_main_layer(const std::string& name) {
    static constexpr std::string_view main[] = {"rgba",  "rgb",    "combined", "beauty",
                                                "color", "colour", "image",    "main"};
    return std::find(std::begin(main), std::end(main), lower(name_of(name))) != std::end(main);
}

bool is_alpha(const std::string& name) { return rank(name) == rank("a") || rank(name) == rank("alpha"); }

LayerChoice choose_layer(const std::vector<std::string>& channels) {
    const std::vector<Layer> layers = layers_of(channels);
    LayerChoice choice;
    if (const Layer* const layer = main_layer(layers)) {
        choice.channels = layer->colours();
        choice.colours = int(choice.channels.size());
        if (const std::string alpha = layer->alpha(); !alpha.empty()) choice.channels.push_back(alpha);
        add_data(*layer, choice.channels);
    } else {
        choice.channels = channels;
        std::stable_sort(choice.channels.begin(), choice.channels.end(),
                         [](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
    }
    const auto is_chosen = [&](const std::string& channel) {
        return std::find(choice.channels.begin(), choice.channels.end(), channel) != choice.channels.end();
    };
    for (const std::string& channel : channels)
        if (!is_chosen(channel)) choice.left_out.push_back(channel);
    for (const std::string& channel : choice.channels)
        choice.names.push_back(layers.size() == 1 || choice.colours > 0 ? name_of(channel) : channel);
    return choice;
}

} // namespace bake
