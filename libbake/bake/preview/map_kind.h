// What a picture that is shown on a shape holds.
#pragma once
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"

namespace bake {

/// What a picture shown on a shape is taken for.
enum class MapKind {
    automatic, ///< as guess_map_kind() finds it
    normal,    ///< tangent-space normal map
    bump,      ///< bump table
    height,    ///< height; float values are lengths, integers have an amplitude of 2 % of the shape's diagonal
    colour,    ///< albedo
};

/// bump: the channels are named b_u and b_v, the file states a SlopeCode, or it has two channels that are no normals;
/// normal: the vectors look like normals (guess_kind()); height: grey; otherwise colour.
MapKind guess_map_kind(const Image<float>& image, const ImageInfo& info);
/// "a normal map" and so on.
const char* name(MapKind kind) noexcept;

} // namespace bake
