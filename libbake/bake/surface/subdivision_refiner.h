// The cage as OpenSubdiv takes it. Within its room only: subdivision*.cpp.
#pragma once
#include "bake/asset/mesh.h"
#include "bake/surface/subdivision_types.h"
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

/// The cage's topology, tags and, when there are any, uvs as face-varying channel 0.
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(const Mesh& cage, const UvValues& uvs,
                                                               const SubdivisionOptions& options);

} // namespace bake
