// A scene of which one thing varies: the method by which the relief of an object is shown.
#pragma once
#include "bake/preview/scene_entries.h"
#include <cstdint>

namespace bake {

/// How options and messages call a mesh: by its name, else by that of its file or shape.
std::string object_name(const MeshEntry& mesh);

/// A built scene, and which of its instances are the object.
struct MethodScene {
    Scene scene;
    std::vector<std::uint8_t> of_object; ///< one entry per instance
    std::int64_t height_bytes = 0;       ///< of the height's values in memory, whether the method looks at them or not
};

/// The camera, the lights and the ground are those of the scene without relief, whatever the method.
class ComparedScene {
public:
    /// `object` is the name of a [[mesh]] whose material has a height; empty: all meshes with a height are the object.
    /// Throws the errors of load(), Error{Refusal::usage} for a name that is not one of these, and
    /// Error{Refusal::unsuitable} if no mesh has a height.
    ComparedScene(const SceneEntries& entries, const std::string& object);

    /// Bakes what the method needs, and builds the scene. Throws the errors of load().
    MethodScene load(const ShadeMethod& method) const;
    /// The same without filters: textures are looked up at points.
    MethodScene load_unfiltered(const ShadeMethod& method) const;
    /// The meshes of a method that displaces, with heights of 0: see without_heights().
    Scene load_base(const ShadeMethod& method) const;

    const std::string& object() const noexcept { return object_; }
    /// Triangles of the object's meshes without relief.
    std::int64_t triangles() const noexcept { return triangles_; }
    /// Of reading the files.
    const std::vector<std::string>& notes() const noexcept { return notes_; }
    const RenderSettings& settings() const noexcept { return entries_.settings; }

private:
    SceneEntries entries_of(const ShadeMethod& method) const;
    MethodScene load(const SceneEntries& entries) const;
    void choose(const std::string& object);
    void read_pictures();
    void fix_view();

    SceneEntries entries_;
    std::vector<int> materials_; ///< of the object, in entries_.materials
    std::string object_;
    std::int64_t triangles_ = 0;
    std::vector<std::string> notes_;
};

/// Bytes that the object takes: its meshes as the tracer holds them, Embree's tree, and `textures`.
std::int64_t object_bytes(const MethodScene& scene);
/// Bytes of what its relief looks up: bump table, normal map or height with their smaller levels, as the tracer holds them.
std::int64_t texture_bytes(const MethodScene& scene);
std::int64_t object_triangles(const MethodScene& scene);

} // namespace bake
