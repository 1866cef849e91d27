// A scene that shows a normal map which is in memory, on the mesh that it is for or on a rectangle.
#pragma once
#include "bake/preview/scene_entries.h"

namespace bake {

struct MapScene {
    int size = 512;       ///< pixels along the longer edge of the picture
    std::string mesh;     ///< file; empty: a rectangle that faces the camera
    Vec2d extent{1};      ///< of the rectangle, object units along u and v
    bool flip_v = false;  ///< how the mesh is read, see MeshOptions
    int uv_set = -1;      ///< likewise
    bool directx = false; ///< green of the map points down
    bool bc5 = false;     ///< the map is shown as BC5 blocks store it
};

/// `map`: three channels, rgb = (n + 1) / 2 in tangent space. Grey and glossy, in the lights of studio_scene(): the key light
/// shines from the upper left of the picture, so that what rises towards the viewer is bright at its upper left. A rectangle
/// fills the picture; a square one shows a mesh as quick_scene() does, without the file's own materials and lights. The exposure
/// is fixed, so that pictures of several maps compare.
SceneEntries map_scene(const MapScene& shown, Image<float> map);

} // namespace bake
