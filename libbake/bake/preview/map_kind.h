// What a picture that is shown on a shape holds.
#pragma once
#include "bake/preview/quick_scene.h"

namespace bake {

/// bump: the channels are named b_u and b_v, the file states a SlopeCode, or it has two channels that are no normals;
/// normal: the vectors look like normals (guess_kind()); height: grey; otherwise colour.
MapKind guess_map_kind(const Image<float>& image, const ImageInfo& info);
/// "a normal map" and so on.
const char* name(MapKind kind) noexcept;

} // namespace bake
