// From the patches of a stage to leaves in the quadtrees.
#include "bake/surface/subdivision/conversion.h"
#include "bake/surface/subdivision/stage.h"

namespace bake {
namespace {

using namespace OpenSubdiv;

void insert_leaf(LimitPatches& limit, const Subdomain& place, std::int32_t leaf) {
    std::int32_t* link = &limit.patches[std::size_t(place.patch)].root;
    const Vec2d centre = (Vec2d(limit.triangles ? 1.0 / 3 : 0.5) - place.leaf.origin) / place.leaf.scale;
    double s = centre.x, t = centre.y;
    for (int depth = 0; depth < place.depth; ++depth) {
        if (*link == missing_leaf) {
            *link = std::int32_t(limit.nodes.size() / 4);
            const std::int32_t node = *link;
            limit.nodes.insert(limit.nodes.end(), 4, missing_leaf); // invalidates link
            link = &limit.nodes[std::size_t(4 * node + step_into_child(limit.triangles, s, t))];
        } else {
            link = &limit.nodes[std::size_t(4 * *link + step_into_child(limit.triangles, s, t))];
        }
    }
    *link = ~leaf;
}

void reserve_leaves(LimitPatches& limit, std::size_t count) {
    if (count <= limit.leaves.capacity()) return;
    // Includes memory for later stages: unused memory costs nothing, but moving the leaves is slow.
    const std::size_t reserved = count + count / 2, terms = std::size_t(limit.terms());
    limit.leaves.reserve(reserved);
    limit.position.reserve(reserved * terms * 3);
    limit.uv.reserve(limit.has_uv ? reserved * terms * 2 : 0);
}

} // namespace

void add_leaves(const Stage& stage, const Far::PatchTable& table, const std::vector<int>& to_refine,
                LimitPatches& limit) {
    Conversions conversions(table, limit.triangles);
    const auto terms = std::size_t(limit.terms());
    reserve_leaves(limit, limit.leaves.size() + std::size_t(table.GetNumPatchesTotal()));
    int index = 0;
    for (int array = 0; array < table.GetNumPatchArrays(); ++array)
        for (int i = 0; i < table.GetNumPatches(array); ++i, ++index) {
            if (!to_refine.empty() && to_refine[std::size_t(index)] >= 0) continue;
            const std::size_t leaf = limit.leaves.size();
            limit.position.resize((leaf + 1) * terms * 3);
            convert(conversions.of(array, i, index, false), stage.points, table.GetPatchVertices(array, i),
                    &limit.position[leaf * terms * 3]);
            if (limit.has_uv) {
                limit.uv.resize((leaf + 1) * terms * 2);
                convert(conversions.of(array, i, index, true), stage.uvs, table.GetPatchFVarValues(array, i, 0),
                        &limit.uv[leaf * terms * 2]);
            }
            const Subdomain place = subdomain_of(stage, table.GetPatchParam(array, i), limit.triangles);
            limit.leaves.push_back(place.leaf);
            insert_leaf(limit, place, std::int32_t(leaf));
        }
}

bool is_complete(const LimitPatches& limit, std::int32_t root) noexcept {
    if (root == missing_leaf) return false;
    if (root < 0) return true;
    for (int child = 0; child < 4; ++child)
        if (!is_complete(limit, limit.nodes[std::size_t(4 * root + child)])) return false;
    return true;
}

} // namespace bake
