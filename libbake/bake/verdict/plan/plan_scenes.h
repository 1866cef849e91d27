// The parts of a scene that is planned: loaded once, and put together with one model or another of each object.
#pragma once
#include "bake/preview/scene_entries.h"
#include <map>
#include <memory>

namespace bake {

struct BakedModel;

/// A mesh with a height or a high-poly mesh, and all meshes like it, which share their model.
struct PlannedObject {
    std::string name;                             ///< no other object has it
    std::string material;                         ///< as in the scene file; empty: none
    std::vector<int> meshes;                      ///< in SceneEntries::meshes
    std::vector<std::uint32_t> instances;         ///< in all scenes of the plan
    Shape* shape = nullptr;                       ///< without relief
    const Material* base = nullptr;               ///< likewise
    std::shared_ptr<const HeightTexture> height;  ///< null: `high` is given
    ReliefOptions relief;                         ///< of the height; its method is not looked at
    HighEntry high;                               ///< its shade is not looked at
    std::shared_ptr<const BakedModel> high_model; ///< by Shade::high; null: `height` is given
    bool repeats = false;                         ///< the uvs are those of the mesh times a factor
};

/// A camera, and the lights that the scene has for it: a scene without lights has some that stand relative to the camera.
struct PlannedCamera {
    std::string name;
    Camera camera;
    std::vector<Light<float>> lights;
    Vec3f ambient{0};
};

/// The material and the shape of an object by one method.
struct BakedModel {
    ShadeMethod method;
    std::unique_ptr<Material> material;
    std::unique_ptr<Shape> shape; ///< displaced; null: that of the object
    std::int64_t triangles = 0;   ///< of one mesh
};
/// A model of about so many triangles of one mesh that shows the whole relief of an object.
ShadeMethod full_method(const PlannedObject& object, double triangles, int most_levels) noexcept;
/// One per object; null: without relief.
using BakedModels = std::vector<std::shared_ptr<const BakedModel>>;

/// A built scene and the models that it shows.
struct AssembledScene {
    Scene scene;
    BakedModels models;
};

/// Cameras, ground and lights are those of the scene without relief, whatever the models.
class PlanScenes {
public:
    /// `cameras`: names; empty: all of the scene. Throws the errors of load(), and Error{Refusal::usage} for a camera that
    /// is not in the scene.
    PlanScenes(const SceneEntries& entries, const std::vector<std::string>& cameras);

    const std::vector<PlannedObject>& objects() const noexcept { return objects_; }
    const std::vector<PlannedCamera>& cameras() const noexcept { return cameras_; }
    const RenderSettings& settings() const noexcept { return entries_.settings; }
    const Scene& plain() const noexcept { return plain_; }
    std::vector<std::uint8_t> instances_of(int object) const;

    /// Bakes what the method needs, unless that is in use already. Throws Error{Refusal::unsuitable} where the method does
    /// not suit the object or needs more memory than there is.
    std::shared_ptr<const BakedModel> bake(int object, const ShadeMethod& method);
    std::unique_ptr<AssembledScene> assemble(BakedModels models) const;
    /// The entries with the cameras and the ground that all scenes of the plan have.
    SceneEntries as_seen(SceneEntries entries) const;
    /// Gives the scene the lights that it has for a camera.
    void light_for(Scene& scene, std::size_t camera) const;

private:
    void choose_objects();
    static std::shared_ptr<BakedModel> bake_height(const PlannedObject& object, const ShadeMethod& method);
    std::shared_ptr<BakedModel> bake_high(const PlannedObject& object, Shade shade) const;
    void load_plain();
    void find_parts();
    void place_cameras(const SceneEntries& given, const std::vector<std::string>& names);
    void fix_ground(const GroundEntry& ground);

    SceneEntries entries_; ///< each object has a material of its own
    Scene plain_;
    std::vector<PlannedObject> objects_;
    std::vector<std::string> own_materials_; ///< names of these, one per object
    std::vector<PlannedCamera> cameras_;
    std::map<std::pair<int, std::string>, std::weak_ptr<const BakedModel>> baked_;
};

} // namespace bake
