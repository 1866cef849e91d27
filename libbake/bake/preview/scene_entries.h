// What a scene file says, checked but with nothing loaded yet; and the loading of it.
#pragma once
#include "bake/preview/scene.h"

namespace bake {

struct MaterialEntry {
    std::string name;
    BlinnPhong<float> bsdf;
    Vec3f reflect{0};
    std::string albedo, bump_table, normal_map; ///< files; empty: none
    ColourSpace albedo_space = ColourSpace::automatic;
    float bump_scale = 1;
    NormalEncoding encoding = NormalEncoding::automatic;
    bool directx = false;
    int line = 0; ///< in the scene file, for messages
};

struct MeshEntry {
    std::string file;
    int material = -1; ///< index in materials; -1: plain grey
    Placement placement;
    bool flat = false;
    bool flip_v = false; ///< as MeshOptions
    int line = 0;
};

struct SkyEntry {
    std::array<std::string, 6> faces; ///< in the order of CubeFace; all empty: `image`
    std::string image;                ///< one picture of the whole sky, as read_environment knows them; empty: no sky
    ColourSpace space = ColourSpace::automatic;
    float scale = 1;
    int line = 0;
};

/// A scene file. Paths are as they are to be opened.
struct SceneEntries {
    std::string file; ///< the scene file's own name, for messages
    RenderSettings settings;
    Vec3f background{0};
    std::optional<Vec3f> camera_position, camera_target; ///< without: the scene is framed
    Vec3f camera_up{0, 1, 0};
    float fov_deg = 40.0f;
    SkyEntry sky;
    std::vector<Light<float>> lights;
    Vec3f ambient{0};
    bool any_light = false; ///< some [[light]] stands in the file
    std::vector<MaterialEntry> materials;
    std::vector<MeshEntry> meshes;
};

/// Reads every mesh, texture and face the entries name (each file once) and builds the scene. Where the entries have
/// neither light nor sky, a directional light from the viewer's upper left is added; where the camera has no position,
/// it frames the scene. Throws Error, "<scene file>:<line>: <file>: ...", as the readers do; Error{Refusal::unsuitable}
/// for a scene without mesh and sky, and for a texture on a mesh without uvs.
Scene load(const SceneEntries& entries);

} // namespace bake
