// What is known of an object before its picture is rendered.
#pragma once
#include "bake/verdict/plan/plan_scenes.h"
#include "bake/verdict/plan/relief_facts.h"

namespace bake {

/// The facts of all meshes of an object in the pictures of all cameras.
class ObjectFacts {
public:
    /// `plain`: the scene without relief, which must outlive the object.
    ObjectFacts(const PlanScenes& scenes, const Scene& plain, int object, float exposure);

    /// One per camera: the worst of the meshes.
    const std::vector<ReliefFacts>& of_cameras() const noexcept { return of_cameras_; }
    /// The largest bound of all views; nothing if one of them has none.
    std::optional<ErrorBound> bound(Shade shade) const;
    bool in_view() const noexcept;
    /// Of all cameras: the worst values.
    ReliefFacts worst() const noexcept;

private:
    struct View {
        FactsInput input;
        ReliefFacts facts;
    };
    std::vector<View> views_;
    std::vector<ReliefFacts> of_cameras_;
};

} // namespace bake
