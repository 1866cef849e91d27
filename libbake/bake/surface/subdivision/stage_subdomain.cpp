#include "bake/surface/subdivision/stage.h"

namespace bake {
namespace {

using namespace OpenSubdiv;

// Child k of a quad or triangle, in Far's order.
Subdomain child_subdomain(bool triangles, int k) {
    if (triangles && k == 3) return {-1, {-2, Vec2d(1)}, 1};
    const bool right = k == 1 || (k == 2 && !triangles), up = k >= 2;
    return {-1, {2, -Vec2d(right, up)}, 1};
}

} // namespace

Subdomain within(const Subdomain& outer, const Subdomain& inner) {
    return {outer.patch,
            {outer.leaf.scale * inner.leaf.scale, inner.leaf.scale * outer.leaf.origin + inner.leaf.origin},
            outer.depth + inner.depth};
}

Subdomain subdomain_of(const Stage& stage, const Far::PatchParam& param, bool triangles) {
    const int depth = param.GetDepth() - param.NonQuadRoot();
    const double parts = double(1 << depth);
    LimitLeaf leaf{parts, Vec2d(-double(param.GetU()), -double(param.GetV()))};
    if (triangles && param.IsTriangleRotated()) leaf = {-parts, Vec2d(parts - param.GetU(), parts - param.GetV())};
    return within(stage.subdomains[std::size_t(param.GetFaceId())], {-1, leaf, depth});
}

std::vector<Subdomain> last_subdomains(const Stage& stage, bool triangles) {
    const Far::TopologyRefiner& refiner = *stage.refiner;
    std::vector<Subdomain> places;
    for (int level = 0; level < refiner.GetMaxLevel(); ++level) {
        const Far::TopologyLevel& faces = refiner.GetLevel(level);
        std::vector<Subdomain> next(std::size_t(refiner.GetLevel(level + 1).GetNumFaces()));
        for (int f = 0; f < faces.GetNumFaces(); ++f) {
            const Far::ConstIndexArray children = faces.GetFaceChildFaces(f);
            const bool one_patch = triangles || faces.GetFaceVertices(f).size() == 4;
            for (int k = 0; k < children.size(); ++k) {
                if (children[k] < 0) continue;
                Subdomain& child = next[std::size_t(children[k])];
                if (level > 0) {
                    child = within(places[std::size_t(f)], child_subdomain(triangles, k));
                    continue;
                }
                // The children of the cage's other faces are its patches.
                const auto first = std::size_t(stage.first[std::size_t(f)]);
                child = one_patch ? within(stage.subdomains[first], child_subdomain(triangles, k))
                                  : stage.subdomains[first + std::size_t(k)];
            }
        }
        places = std::move(next);
    }
    return places;
}

} // namespace bake
