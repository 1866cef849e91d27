// The checked content of a scene file, and the function that loads its files.
#pragma once
#include "bake/environment/filter/sky_reduction.h"
#include "bake/preview/camera_entry.h"
#include "bake/preview/high_entry.h"
#include "bake/preview/material_entry.h"
#include "bake/preview/scene.h"
#include "bake/surface/subdivision/types.h"
#include <optional>

namespace bake {

struct MeshEntry {
    std::string file;                ///< empty if `shape` is given
    std::string name;                ///< for instances; may be empty
    std::string shape;               ///< see shape_mesh()
    int columns = 0, rows = 0;       ///< of a shape, see shape_mesh()
    HighEntry high;                  ///< of a file; the material has neither a height nor a map of normals or slopes
    std::optional<Scheme> subdivide; ///< the file is a cage, and its limit is shown; columns: segments of an edge
    Vec2f repeat{1};                 ///< factor on the uvs
    int material = -1;               ///< index in materials; -1 is plain grey
    bool own_materials = true;       ///< a glTF that has materials is shown with them instead
    bool lights = true;              ///< the lights of a glTF shine in the scene
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
    SkyReduction reduction;
    std::string irradiance;    ///< file for SkyLighting::irradiance; empty: computed
    std::string specular;      ///< the same, six files with levels
    std::vector<float> alphas; ///< of the levels in `specular`
    int line = 0;
};

/// A square that faces up.
struct GroundEntry {
    std::optional<float> height; ///< y; if not given, just below the meshes
    std::optional<float> size;   ///< edge; if not given, 20 times the diagonal of the meshes
    int material = -1;
    Vec2f repeat{1}; ///< how often textures repeat over the square
    int line = 0;
};

/// The content of a scene file. Paths include the folder of the scene file.
struct SceneEntries {
    std::string file; ///< name of the scene file, for messages
    RenderSettings settings;
    Vec3f background{0};
    std::vector<CameraEntry> cameras; ///< if empty, the camera shows the whole scene
    std::size_t camera = 0;           ///< the one that is taken
    SkyEntry sky;
    std::vector<Light<float>> lights;
    Vec3f ambient{0};
    bool any_light = false; ///< true if the file has a [[light]]
    std::vector<MaterialEntry> materials;
    std::vector<MeshEntry> meshes;
    std::optional<GroundEntry> ground;
    bool labels = false;     ///< the built-in test sky (label_sky()), instead of `sky`
    LoadedPictures pictures; ///< files that are read already
    bool studio = false;     ///< without lights and sky: three lights placed relative to the camera instead of one
};

/// The camera that is taken; an entry that shows the whole scene if there is none.
const CameraEntry& chosen_camera(const SceneEntries& entries) noexcept;

/// Reads all meshes, textures and faces (each file once) and builds the scene. Without lights and sky, adds a directional
/// light from the upper left of the camera. Without a camera position, the camera shows the whole scene. Throws the errors
/// of the readers with "<scene file>:<line>: " in front, and Error{Refusal::unsuitable} for a scene without mesh and sky and
/// for a texture on a mesh without uvs.
Scene load(const SceneEntries& entries);

} // namespace bake
