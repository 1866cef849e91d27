// The texels just outside of the charts of a normal map.
#pragma once
#include "bake/picture/image.h"

namespace bake {

/// Gives each texel beside an owned one, which a bilinear filter blends with it on the border of the chart, the linear continuation
/// of the owned texels behind its neighbours, 2 near - far, so that what is read on the border is what lies there, on both sides of
/// a seam. Where near and far differ by more than 30 degrees, it is a copy of the near one. The filled texels become owned.
/// `map`: encoded normals, three channels. Returns the number of texels filled.
std::int64_t continue_charts(Image<float>& map, Image<unsigned char>& owned);

} // namespace bake
