#include "bake/surface/subdivision_refiner.h"
#include <algorithm>
#include <cassert>
#include <numeric>
#include <opensubdiv/far/topologyDescriptor.h>
#include <tuple>

namespace bake {

UvValues uv_values(const Mesh& cage) {
    UvValues uvs;
    if (cage.corner_uv.empty()) return uvs;
    const auto uv_at = [&](std::uint32_t c) {
        return cage.corner_uv[c] == no_index ? Vec2f(0) : cage.uvs[cage.corner_uv[c]];
    };
    std::vector<std::uint32_t> order(cage.corners());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t c) {
        const Vec2f uv = uv_at(c);
        return std::tuple(cage.corner_position[c], uv.x, uv.y);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    uvs.corner.resize(cage.corners());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || key(order[i]) != key(order[i - 1])) uvs.values.push_back({Vec2d(uv_at(order[i]))});
        uvs.corner[order[i]] = int(uvs.values.size()) - 1;
    }
    return uvs;
}

std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(const Mesh& cage, const UvValues& uvs,
                                                               const SubdivisionOptions& options) {
    using namespace OpenSubdiv;
    std::vector<int> sizes(cage.faces());
    for (std::size_t f = 0; f < cage.faces(); ++f) sizes[f] = int(cage.face_begin[f + 1] - cage.face_begin[f]);
    std::vector<int> creases, corners;
    std::vector<float> crease_weights, corner_weights;
    for (const SubdivisionTags::Crease& crease : cage.tags.creases) {
        creases.insert(creases.end(), {int(crease.a), int(crease.b)});
        crease_weights.push_back(std::clamp(crease.sharpness, 0.0f, 10.0f));
    }
    for (const SubdivisionTags::Corner& corner : cage.tags.corners) {
        corners.push_back(int(corner.position));
        corner_weights.push_back(std::clamp(corner.sharpness, 0.0f, 10.0f));
    }

    Far::TopologyDescriptor cage_of;
    cage_of.numVertices = int(cage.positions.size());
    cage_of.numFaces = int(cage.faces());
    cage_of.numVertsPerFace = sizes.data();
    cage_of.vertIndicesPerFace = reinterpret_cast<const int*>(cage.corner_position.data());
    cage_of.numCreases = int(crease_weights.size());
    cage_of.creaseVertexIndexPairs = creases.data();
    cage_of.creaseWeights = crease_weights.data();
    cage_of.numCorners = int(corner_weights.size());
    cage_of.cornerVertexIndices = corners.data();
    cage_of.cornerWeights = corner_weights.data();
    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = int(uvs.values.size());
    channel.valueIndices = uvs.corner.data();
    if (!uvs.corner.empty()) {
        cage_of.numFVarChannels = 1;
        cage_of.fvarChannels = &channel;
    }

    Sdc::Options rules;
    switch (cage.tags.boundary) {
    case SubdivisionTags::Boundary::none: rules.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_NONE); break;
    case SubdivisionTags::Boundary::edge_only:
        rules.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
        break;
    case SubdivisionTags::Boundary::edge_and_corner:
        rules.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
        break;
    }
    switch (options.uv) {
    case UvSmoothing::none: rules.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_ALL); break;
    case UvSmoothing::inside: rules.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_BOUNDARIES); break;
    case UvSmoothing::all: rules.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_NONE); break;
    }
    const Sdc::SchemeType scheme = options.scheme == Scheme::loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(cage_of, Factory::Options(scheme, rules)));
    assert(refiner); // check_cage came first
    return refiner;
}

} // namespace bake
