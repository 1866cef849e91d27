// Selects the channels of an OpenEXR picture that are read. Files of renderers have depth, normals and further layers
// beside the picture itself.
#pragma once
#include <string>
#include <vector>

namespace bake {

struct LayerChoice {
    std::vector<std::string> channels; ///< whole names, in the order in which they are given
    std::vector<std::string> names;    ///< the same without the name of the layer: "R" for "ViewLayer.Combined.R"
    std::vector<std::string> left_out; ///< whole names of the others
    int colours = 0;                   ///< the first channels that are colour or grey; 0: the names do not tell
};

/// Of the layer without a name, or else of the main one (rgba, Combined, beauty, ...): R, G, B, or Y, or R and G, or X, Y
/// and Z of a vector, in any case of letters, and A; further channels of that layer whose names say nothing, if these are
/// at most four in all. All channels when no layer has any of these.
LayerChoice choose_layer(const std::vector<std::string>& channels);

/// Whether a layer or part of this name usually is the picture itself.
bool is_main_layer(const std::string& name);

/// Whether the name of a channel, without its layer, is that of alpha.
bool is_alpha(const std::string& name);

} // namespace bake
