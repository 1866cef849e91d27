// Conversion of a cage to OpenSubdiv. Internal to this room.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/surface/subdivision/types.h"
#include <memory>
#include <opensubdiv/far/topologyRefiner.h>

namespace bake {

/// A value with the interface of OpenSubdiv's refiners and stencils.
template <class V> struct Weighted {
    V value{0};
    void Clear() noexcept { value = V(0); }
    void AddWithWeight(const Weighted& other, double weight) noexcept { value += weight * other.value; }
};

/// Face-varying uvs. Corners at one position with equal uvs share a value. Corners without uv have the value zero,
/// which they share with no uv.
struct UvValues {
    std::vector<Weighted<Vec2d>> values;
    std::vector<int> corner; ///< value of each corner; empty without uvs
};
UvValues uv_values(const Mesh& cage);

/// Topology and tags. Sharpness 10 is infinite.
struct RefinerInput {
    int positions = 0, uvs = 0;
    std::vector<int> sizes, corner_position, corner_uv; ///< corner_uv is empty without uvs
    std::vector<int> creases, corners;                  ///< creases: pairs of positions
    std::vector<float> crease_weights, corner_weights;
};
RefinerInput refiner_input(const Mesh& cage, const UvValues& uvs);

/// A refiner with level 0 only. Uvs are face-varying channel 0.
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(const RefinerInput& input,
                                                               SubdivisionTags::Boundary boundary,
                                                               const SubdivisionOptions& options);

} // namespace bake
