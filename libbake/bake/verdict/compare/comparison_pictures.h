// The pictures and charts of a comparison of methods.
#pragma once
#include "bake/verdict/compare/scene_comparison.h"

namespace bake {

struct NamedPicture {
    std::string name;     ///< of a file
    Image<float> picture; ///< three channels, sRGB-encoded
};

/// reference.png, and for each method its picture at the exposure of the reference and METHOD_error.png, its FLIP errors in
/// false colour from 0 to 1. ':' and '+' of a method become '_'.
std::vector<NamedPicture> method_pictures(const SceneComparison& comparison);
/// All of them with captions, each method beside its errors, and the scale of the false colours; sRGB-encoded.
Image<float> comparison_sheet(const SceneComparison& comparison);
/// SVG: RMSE over the object's pixels against the seconds to prepare and render, and against the bytes of the object.
std::string time_chart(const SceneComparison& comparison);
std::string bytes_chart(const SceneComparison& comparison);

} // namespace bake
