// Corresponding points of two displacements of one surface, with any heights and segments.
//
// A displaced mesh has the faces and corners of the mesh that the same call gives for heights of 0, so that a triangle and
// barycentrics are a point of the surface without relief. Two meshes without relief show the same surface there, up to how
// finely each is tessellated: the counterpart of a point is the nearest one.
#pragma once
#include "bake/mesh/triangle_tree.h"
#include "bake/preview/scene_entries.h"

namespace bake {

/// The entries of the same objects with heights of 0 and the same segments: the base scene of TwinPoints. Sky, ground and
/// the lights of files are left out.
SceneEntries without_heights(SceneEntries entries);

/// A shape as it is shown, and the same one without relief: the same shape if it is not displaced.
struct TwinShape {
    const Shape* shown = nullptr;
    const Shape* base = nullptr;
};

/// Maps points from one displacement of a surface to another. The shapes must outlive it.
class TwinPoints {
public:
    /// Throws Error{Refusal::unsuitable} if a shape has not the faces of its base, or a base has no triangles.
    TwinPoints(const TwinShape& from, const TwinShape& to);

    /// Where the base surface has several sheets at one place, it may be a point of any of them.
    ShapePoint operator()(const ShapePoint& at) const noexcept;

private:
    TwinShape from_, to_;
    TriangleTree tree_; ///< of to_.base
};

} // namespace bake
