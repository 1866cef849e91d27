// A scene made for one mesh, or for one map on a shape, without a scene file.
#pragma once
#include "bake/preview/map_kind.h"
#include "bake/preview/scene_entries.h"

namespace bake {

struct QuickScene {
    std::string mesh;  ///< file; empty if a map is shown
    std::string map;   ///< file of a picture
    std::string shape; ///< of the map: see shape_mesh()
    MapKind as = MapKind::automatic;
    std::string material; ///< see material_of()
};

/// A mesh, or a shape with a map, that its camera frames and three lights light. A plane faces the camera. A map is repeated
/// over the shapes sphere and torus so that it is less stretched, unless the material gives `repeat`. `notes` receives what
/// was found or assumed, with fields of QuickScene in backquotes. Throws Error as the readers and material_of().
SceneEntries quick_scene(const QuickScene& quick, std::vector<std::string>& notes);

/// A scene without meshes: a dark grey background and three lights, placed relative to the camera (add_studio_lights()).
SceneEntries studio_scene();
/// A material of it that shows relief, for material_of().
inline constexpr const char* studio_material = "specular=0.25,shininess=40";

/// By the text: "diffuse=.8,reflect=.2:.3:.4,albedo=wood.png": keys of [[material]] of a scene file; colours are grey, r:g:b
/// (linear) or #rrggbb (sRGB). A later value replaces an earlier one, and all replace those of `defaults`. Files are
/// relative to the working folder. Throws Error{Refusal::usage} that starts with "`material` TEXT: ".
MaterialEntry material_of(const std::string& text, const std::string& defaults = {});

/// The cameras of a .gltf or .glb; none for other meshes. Throws as read_gltf_cameras.
std::vector<CameraEntry> cameras_of(const std::string& mesh);

/// The sky of a scene becomes `name`: "labels", or one input of read_environment().
void set_sky(SceneEntries& entries, const std::string& name);

} // namespace bake
