#include "bake/relief/transfer/witness.h"
#include <algorithm>
#include <limits>
#include <optional>

namespace bake {
namespace {

/// Nothing where the centre of the texel lies on a part without a source; rays beside the centre can find detail there.
std::optional<Witness> witness_at(const BakeTarget& target, const TransferSources& sources, int x, int y) {
    Witness out{.x = x, .y = y};
    const TexelHit& at = target.raster.hits.at(x, y);
    const Mesh& mesh = *target.surface.mesh;
    const Triangle& triangle = target.surface.triangles[at.triangle];
    const double b[3] = {1.0 - double(at.b1) - double(at.b2), double(at.b1), double(at.b2)};
    for (std::size_t k = 0; k < 3; ++k) out.uv += b[k] * Vec2d(mesh.uvs[mesh.corner_uv[triangle.corner[k]]]);
    out.face = triangle.face;
    const TransferSource* const source = sources.of(out.face);
    if (!source) return {};
    out.cast = source->casting->at(at);
    return out;
}

void set_nearest(Witness& witness, const HighSurface& high) {
    const Vec3f p = witness.cast.start + witness.cast.reach.front * witness.cast.inward;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < high.count(); ++i)
        for (const Vec3f& q : high.mesh(i).positions) {
            const float squared = glm::dot(q - p, q - p);
            if (!(squared < least)) continue;
            least = squared, witness.nearest = q, witness.mesh = high.name(i);
        }
    witness.distance = std::sqrt(double(least));
}

} // namespace

std::vector<Witness> missed_texels(const BakeTarget& target, const TransferSources& sources, const Transfer& result,
                                   std::size_t most) {
    std::vector<Witness> out;
    for (int y = 0; y < result.states.height() && result.report.missed > 0; ++y)
        for (int x = 0; x < result.states.width() && out.size() < most; ++x) {
            const TexelState state = result.states.at(x, y);
            if (!is_missed(state)) continue;
            if (target.raster.hits.at(x, y).triangle == no_index) continue; // a sample beside the centre was in a chart
            const std::optional<Witness> witness = witness_at(target, sources, x, y);
            if (!witness) continue;
            out.push_back(*witness);
            out.back().state = state;
            set_nearest(out.back(), *sources.of(out.back().face)->high);
        }
    return out;
}

std::vector<Witness> farthest_texels(const BakeTarget& target, const TransferSources& sources, const Transfer& result,
                                     std::size_t most) {
    std::vector<Witness> out;
    for (const FarTexel& far : result.far) {
        if (out.size() == most) break;
        if (target.raster.hits.at(far.x, far.y).triangle == no_index) continue;
        const std::optional<Witness> witness = witness_at(target, sources, far.x, far.y);
        if (!witness) continue;
        out.push_back(*witness);
        out.back().state = TexelState::hit, out.back().height = far.height;
    }
    return out;
}

} // namespace bake
