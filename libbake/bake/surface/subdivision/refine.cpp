#include "bake/base/error.h"
#include "bake/surface/subdivision/refiner.h"
#include "bake/surface/subdivision/subdivision.h"
#include <cassert>
#include <new>
#include <opensubdiv/far/primvarRefiner.h>

namespace bake {
namespace {

using namespace OpenSubdiv;

void keep_tags(const Far::TopologyLevel& level, SubdivisionTags& tags) {
    for (int e = 0; e < level.GetNumEdges(); ++e) {
        const float sharpness = level.GetEdgeSharpness(e);
        if (!(sharpness > 0) || level.GetEdgeFaces(e).size() < 2) continue; // borders are sharp by themselves
        const Far::ConstIndexArray ends = level.GetEdgeVertices(e);
        tags.creases.push_back({std::uint32_t(ends[0]), std::uint32_t(ends[1]), sharpness});
    }
    for (int v = 0; v < level.GetNumVertices(); ++v)
        if (const float sharpness = level.GetVertexSharpness(v); sharpness > 0)
            tags.corners.push_back({std::uint32_t(v), sharpness});
}

// Values of the last level, each level from the one before.
template <class V>
std::vector<Weighed<V>> last_values(const Far::TopologyRefiner& refiner, std::vector<Weighed<V>> values,
                                    bool face_varying) {
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    for (int i = 1; i <= refiner.GetMaxLevel(); ++i) {
        const Far::TopologyLevel& level = refiner.GetLevel(i);
        std::vector<Weighed<V>> next(std::size_t(face_varying ? level.GetNumFVarValues(0) : level.GetNumVertices()));
        if (face_varying) primvars.InterpolateFaceVarying(i, values, next, 0);
        else primvars.Interpolate(i, values, next);
        values = std::move(next);
    }
    return values;
}

Mesh refined(const Mesh& cage, const SubdivisionOptions& options, int levels) {
    UvValues uvs = uv_values(cage);
    const std::unique_ptr<Far::TopologyRefiner> refiner =
        make_refiner(refiner_input(cage, uvs), cage.tags.boundary, options);
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    const Far::TopologyLevel& last = refiner->GetLevel(levels);

    std::vector<Weighed<Vec3d>> positions(cage.positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i].value = Vec3d(cage.positions[i]);
    Mesh mesh;
    for (const auto& p : last_values(*refiner, std::move(positions), false)) mesh.positions.emplace_back(p.value);
    const bool has_uv = !uvs.corner.empty();
    if (has_uv)
        for (const auto& uv : last_values(*refiner, std::move(uvs.values), true)) mesh.uvs.emplace_back(uv.value);

    std::vector<std::uint32_t> origin(std::size_t(last.GetNumFaces()));
    for (int f = 0; f < last.GetNumFaces(); ++f) {
        Far::Index parent = f;
        for (int i = levels; i > 0; --i) parent = refiner->GetLevel(i).GetFaceParentFace(parent);
        origin[std::size_t(f)] = std::uint32_t(parent);
        const Far::ConstIndexArray corners = last.GetFaceVertices(f);
        for (const Far::Index v : corners) mesh.corner_position.push_back(std::uint32_t(v));
        if (has_uv)
            for (const Far::Index v : last.GetFaceFVarValues(f, 0)) mesh.corner_uv.push_back(std::uint32_t(v));
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
    }
    mesh.materials = cage.materials;
    mesh.groups = cage.groups;
    for (const std::uint32_t f : origin) {
        if (!cage.face_material.empty()) mesh.face_material.push_back(cage.face_material[f]);
        if (!cage.face_group.empty()) mesh.face_group.push_back(cage.face_group[f]);
    }
    mesh.tags.boundary = cage.tags.boundary;
    keep_tags(last, mesh.tags);
    return mesh;
}

} // namespace

Mesh refine(const Mesh& cage, const SubdivisionOptions& options, int levels) {
    assert(levels >= 0 && levels <= 15);
    try {
        return refined(cage, options, levels);
    } catch (const std::bad_alloc&) {
        throw Error(Refusal::unsuitable, "a cage of " + std::to_string(cage.faces()) + " faces refined " +
                                             std::to_string(levels) +
                                             " times needs more memory than there is; use fewer levels");
    }
}

} // namespace bake
