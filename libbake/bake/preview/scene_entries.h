// The checked content of a scene file, and the function that loads its files.
#pragma once
#include "bake/preview/relief_method.h"
#include "bake/preview/scene.h"

namespace bake {

/// A height and how it is shown; the numbers mean what they mean to `bake displace`.
struct ReliefEntry {
    std::string file;
    std::optional<float> amplitude; ///< object units, or a part of the diagonal; none: as default_amplitude() says
    bool relative = false;          ///< the amplitude is a part of the diagonal of the mesh
    std::optional<float> midlevel;
    Filter filter = Filter::automatic;
    Wrap wrap = Wrap::repeat;
    std::optional<ShadeMethod> shade; ///< none: exact
};

struct MaterialEntry {
    std::string name;
    BlinnPhong<float> bsdf;
    Vec3f reflect{0};
    std::string albedo, bump_table, normal_map; ///< files; empty if not given
    ColourSpace albedo_space = ColourSpace::automatic;
    float bump_scale = 1;
    NormalEncoding encoding = NormalEncoding::automatic;
    bool directx = false;
    ReliefEntry relief;
    int line = 0; ///< line in the scene file, for messages
};

struct MeshEntry {
    std::string file;
    int material = -1; ///< index in materials; -1 is plain grey
    Placement placement;
    bool flat = false;
    bool flip_v = false; ///< see MeshOptions
    int uv_set = -1;     ///< see MeshOptions
    int line = 0;
};

struct SkyEntry {
    std::array<std::string, 6> faces; ///< in the order of CubeFace; all empty if `image` is given
    std::string image;                ///< one input of read_environment(): a picture, or a pattern of six faces
    ColourSpace space = ColourSpace::automatic;
    BadPolicy bad = BadPolicy::refuse;
    float scale = 1, yaw_deg = 0;
    int line = 0;
};

/// The content of a scene file. Paths include the folder of the scene file.
struct SceneEntries {
    std::string file; ///< name of the scene file, for messages
    RenderSettings settings;
    Vec3f background{0};
    std::optional<Vec3f> camera_position, camera_target; ///< if not given, the camera shows the whole scene
    Vec3f camera_up{0, 1, 0};
    float fov_deg = 40.0f;
    SkyEntry sky;
    std::vector<Light<float>> lights;
    Vec3f ambient{0};
    bool any_light = false; ///< true if the file has a [[light]]
    std::vector<MaterialEntry> materials;
    std::vector<MeshEntry> meshes;
};

/// Reads all meshes, textures and faces (each file once) and builds the scene. Without lights and sky, adds a directional
/// light from the upper left of the camera. Without a camera position, the camera shows the whole scene. Throws the errors
/// of the readers with "<scene file>:<line>: " in front, and Error{Refusal::unsuitable} for a scene without mesh and sky and
/// for a texture on a mesh without uvs.
Scene load(const SceneEntries& entries);

} // namespace bake
