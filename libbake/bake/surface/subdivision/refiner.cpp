#include "bake/surface/subdivision/refiner.h"
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
        return std::tuple(cage.corner_position[c], cage.corner_uv[c] == no_index, uv.x, uv.y);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    uvs.corner.resize(cage.corners());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || key(order[i]) != key(order[i - 1])) uvs.values.push_back({Vec2d(uv_at(order[i]))});
        uvs.corner[order[i]] = int(uvs.values.size()) - 1;
    }
    return uvs;
}

RefinerInput refiner_input(const Mesh& cage, const UvValues& uvs) {
    RefinerInput input;
    input.positions = int(cage.positions.size());
    input.uvs = int(uvs.values.size());
    for (std::size_t f = 0; f < cage.faces(); ++f)
        input.sizes.push_back(int(cage.face_begin[f + 1] - cage.face_begin[f]));
    input.corner_position.assign(cage.corner_position.begin(), cage.corner_position.end());
    input.corner_uv = uvs.corner;
    for (const SubdivisionTags::Crease& crease : cage.tags.creases) {
        input.creases.insert(input.creases.end(), {int(crease.a), int(crease.b)});
        input.crease_weights.push_back(std::clamp(crease.sharpness, 0.0f, 10.0f));
    }
    for (const SubdivisionTags::Corner& corner : cage.tags.corners) {
        input.corners.push_back(int(corner.position));
        input.corner_weights.push_back(std::clamp(corner.sharpness, 0.0f, 10.0f));
    }
    return input;
}

std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(const RefinerInput& input,
                                                               SubdivisionTags::Boundary boundary,
                                                               const SubdivisionOptions& options) {
    using namespace OpenSubdiv;
    Far::TopologyDescriptor cage;
    cage.numVertices = input.positions;
    cage.numFaces = int(input.sizes.size());
    cage.numVertsPerFace = input.sizes.data();
    cage.vertIndicesPerFace = input.corner_position.data();
    cage.numCreases = int(input.crease_weights.size());
    cage.creaseVertexIndexPairs = input.creases.data();
    cage.creaseWeights = input.crease_weights.data();
    cage.numCorners = int(input.corner_weights.size());
    cage.cornerVertexIndices = input.corners.data();
    cage.cornerWeights = input.corner_weights.data();
    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = input.uvs;
    channel.valueIndices = input.corner_uv.data();
    cage.numFVarChannels = input.corner_uv.empty() ? 0 : 1;
    cage.fvarChannels = &channel;

    using Rules = Sdc::Options;
    Rules rules;
    switch (boundary) {
    case SubdivisionTags::Boundary::none: rules.SetVtxBoundaryInterpolation(Rules::VTX_BOUNDARY_NONE); break;
    case SubdivisionTags::Boundary::edge_only: rules.SetVtxBoundaryInterpolation(Rules::VTX_BOUNDARY_EDGE_ONLY); break;
    case SubdivisionTags::Boundary::edge_and_corner:
        rules.SetVtxBoundaryInterpolation(Rules::VTX_BOUNDARY_EDGE_AND_CORNER);
        break;
    }
    switch (options.uv) {
    case UvSmoothing::none: rules.SetFVarLinearInterpolation(Rules::FVAR_LINEAR_ALL); break;
    case UvSmoothing::inside: rules.SetFVarLinearInterpolation(Rules::FVAR_LINEAR_BOUNDARIES); break;
    case UvSmoothing::all: rules.SetFVarLinearInterpolation(Rules::FVAR_LINEAR_NONE); break;
    }
    const Sdc::SchemeType scheme = options.scheme == Scheme::loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(cage, Factory::Options(scheme, rules)));
    assert(refiner); // check_cage() excludes failures
    return refiner;
}

} // namespace bake
