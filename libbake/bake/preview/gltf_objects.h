// glTF files in a scene: their meshes with the materials of the file, and their lights.
#pragma once
#include "bake/mesh/gltf/lights.h"
#include "bake/preview/scene.h"

namespace bake {

/// Faces of a glTF file with one material. The scene owns both.
struct GltfObject {
    Shape* shape;
    const Material* material;
};

struct GltfObjectOptions {
    bool flat = false;   ///< facet normals also where the file has normals
    bool flip_v = false; ///< as MeshOptions
    Vec2f repeat{1};     ///< factor on the uvs
};

/// Reads the file, and adds its shapes and materials to the scene, but no instances. One part for each material that has
/// faces. Faces without normals are flat, as the format asks; faces without a material have its default, a rough white
/// metal. Tangents are those of the file where it has them. Throws as read_gltf. The scene's notes receive what the file
/// has that is not shown.
std::vector<GltfObject> load_gltf_objects(const std::string& path, const GltfObjectOptions& options, Scene& scene);

/// The light where an instance of its file stands. An intensity of I candela has the irradiance I / r^2 at the distance r, a
/// directional light of E lux the irradiance E. The scale of the instance moves a light, but does not change its intensity.
Light<float> placed_light(const GltfLight& light, const Instance& instance);

} // namespace bake
