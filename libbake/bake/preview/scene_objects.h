// Reads what stands in a scene, and the cameras that see it: [camera], [ground], [[instance]] and the keys they share with
// [[mesh]]. Internal to this room.
#pragma once
#include "bake/preview/scene_entries.h"
#include "bake/preview/scene_section.h"

namespace bake {

/// One table [camera], or any number of [[camera]], each with a name of its own.
void read_cameras(const toml::table& root, SceneEntries& scene);
/// [[material]]; in scene_io.cpp.
void read_material(const Section& in, SceneEntries& scene);
void read_ground(const Section& in, SceneEntries& scene);
/// An instance becomes a mesh entry of the same file or shape as the [[mesh]] that it names.
void read_instance(const Section& in, SceneEntries& scene);

/// "translate", "rotate-deg", "scale".
void read_placement(const Section& in, Placement& placement);
/// "repeat": one number or two, above 0.
void read_repeat(const Section& in, Vec2f& repeat);
/// "file", or "shape" and "segments": exactly one of the two.
void read_mesh_source(const Section& in, MeshEntry& mesh);
/// "high", "shade", "normal-size" and "normal-depth". Reads a mesh whose source, material and "flat" are known.
void read_high(const Section& in, const SceneEntries& scene, MeshEntry& mesh);
/// "name", which no other mesh has.
void read_mesh_name(const Section& in, const SceneEntries& scene, MeshEntry& mesh);
/// "material": sets the index of the material of that name, if the key exists.
void read_material_name(const Section& in, const SceneEntries& scene, int& material);

} // namespace bake
