// The cage as OpenSubdiv takes it. Within its room only: subdivision*.cpp.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/surface/subdivision/types.h"
#include <memory>
#include <opensubdiv/far/topologyRefiner.h>

namespace bake {

/// A value that OpenSubdiv's refiners and stencils can weigh.
template <class V> struct Weighed {
    V value{0};
    void Clear() noexcept { value = V(0); }
    void AddWithWeight(const Weighed& other, double weight) noexcept { value += weight * other.value; }
};

/// Values of uv as OpenSubdiv has them: one for each corner, shared where corners at one position have equal uvs.
/// Corners without uv share a value of zero per position.
struct UvValues {
    std::vector<Weighed<Vec2d>> values;
    std::vector<int> corner; ///< corners; none without uvs
};
UvValues uv_values(const Mesh& cage);

/// Topology and tags as OpenSubdiv takes them. Sharpness 10 is infinite.
struct RefinerInput {
    int positions = 0, uvs = 0;
    std::vector<int> sizes, corner_position, corner_uv; ///< corner_uv: none without uvs
    std::vector<int> creases, corners;                  ///< creases in pairs
    std::vector<float> crease_weights, corner_weights;
};
RefinerInput refiner_input(const Mesh& cage, const UvValues& uvs);

/// Not yet refined; uvs are face-varying channel 0.
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(const RefinerInput& input,
                                                               SubdivisionTags::Boundary boundary,
                                                               const SubdivisionOptions& options);

} // namespace bake
