// From the patches of a stage to leaves in the quadtrees.
#include "bake/surface/subdivision/conversion.h"
#include "bake/surface/subdivision/crease_pieces.h"
#include "bake/surface/subdivision/stage.h"
#include <algorithm>
#include <bit>

namespace bake {
namespace {

using namespace OpenSubdiv;

/// `tree` is a leaf or a node of leaves.
void insert(LimitPatches& limit, const Subdomain& place, std::int32_t tree) {
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
    *link = tree;
}

std::size_t add_leaf(LimitPatches& limit, const LimitLeaf& leaf) {
    const auto terms = std::size_t(limit.terms());
    limit.leaves.push_back(leaf);
    limit.position.resize(limit.leaves.size() * terms * 3);
    if (limit.has_uv) limit.uv.resize(limit.leaves.size() * terms * 2);
    return limit.leaves.size() - 1;
}

/// The tree over [begin, end] of leaves that are strips across s or t.
std::int32_t tree_of_strips(LimitPatches& limit, const std::vector<CreasePiece>& pieces, std::size_t first_leaf,
                            bool across_s, double begin, double end) {
    for (std::size_t k = 0; k < pieces.size(); ++k)
        if (pieces[k].begin <= begin && end <= pieces[k].end) return ~std::int32_t(first_leaf + k);
    const double middle = (begin + end) / 2;
    const std::int32_t low = tree_of_strips(limit, pieces, first_leaf, across_s, begin, middle);
    const std::int32_t high = tree_of_strips(limit, pieces, first_leaf, across_s, middle, end);
    if (across_s) limit.nodes.insert(limit.nodes.end(), {low, high, low, high});
    else limit.nodes.insert(limit.nodes.end(), {low, low, high, high});
    return std::int32_t(limit.nodes.size() / 4) - 1;
}

/// A patch of the table, in all its arrays.
struct PatchPlace {
    int array, patch;
    int index; ///< counted over all arrays
};

/// The uvs of a piece. Where a border of the uvs follows the crease, Far repeats one point beyond it.
void add_uvs(const Stage& stage, const Far::PatchTable& table, const PatchPlace& at, const Conversion* creased,
             int side, Conversions& conversions, double* out) {
    const Far::ConstIndexArray points = table.GetPatchFVarValues(at.array, at.patch, 0);
    constexpr int beyond[4][4] = {{0, 1, 2, 3}, {3, 7, 11, 15}, {12, 13, 14, 15}, {0, 4, 8, 12}};
    const bool border = !creased || std::all_of(std::begin(beyond[side]), std::end(beyond[side]),
                                                [&](int k) { return points[k] == points[5]; });
    convert(border ? conversions.of(at.array, at.patch, at.index, true) : *creased, stage.uvs, points, out);
}

/// Of the crease along one side of a regular patch; 0 without such a crease.
float sharpness_of(const Far::PatchTable& table, int index) {
    const std::vector<Far::Index>& numbers = table.GetSharpnessIndexTable();
    if (numbers.empty() || numbers[std::size_t(index)] < 0) return 0;
    return table.GetSharpnessValues()[std::size_t(numbers[std::size_t(index)])];
}

/// A regular patch with a semi-sharp crease along one side.
void add_creased_patch(const Stage& stage, const Far::PatchTable& table, const PatchPlace& at, float sharpness,
                       Conversions& conversions, LimitPatches& limit) {
    const Far::PatchParam param = table.GetPatchParam(at.array, at.patch);
    const int side = std::countr_zero(unsigned(param.GetBoundary()));
    const bool across_s = crease_is_along_t(side);
    const auto terms = std::size_t(limit.terms());
    const Subdomain place = subdomain_of(stage, param, false);
    const std::vector<CreasePiece> pieces = crease_pieces(side, sharpness, 0);
    std::vector<CreasePiece> of_uvs;
    if (limit.has_uv && table.GetFVarPatchDescriptorRegular(0).GetType() == Far::PatchDescriptor::REGULAR) {
        const Far::PatchParam uv = table.GetPatchFVarPatchParam(at.array, at.patch, 0);
        if (uv.IsRegular()) of_uvs = crease_pieces(side, sharpness, uv.GetBoundary() & ~(1 << side));
    }
    const std::size_t first = limit.leaves.size();
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        LimitLeaf leaf = place.leaf;
        if (across_s) leaf.end_a = pieces[k].end;
        const std::size_t number = add_leaf(limit, leaf);
        convert(pieces[k].conversion, stage.points, table.GetPatchVertices(at.array, at.patch),
                &limit.position[number * terms * 3]);
        if (limit.has_uv)
            add_uvs(stage, table, at, of_uvs.empty() ? nullptr : &of_uvs[k].conversion, side, conversions,
                    &limit.uv[number * terms * 2]);
    }
    insert(limit, place, tree_of_strips(limit, pieces, first, across_s, 0, 1));
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
            if (const float sharpness = sharpness_of(table, index); sharpness > 0) {
                add_creased_patch(stage, table, {array, i, index}, sharpness, conversions, limit);
                continue;
            }
            const Subdomain place = subdomain_of(stage, table.GetPatchParam(array, i), limit.triangles);
            const std::size_t leaf = add_leaf(limit, place.leaf);
            convert(conversions.of(array, i, index, false), stage.points, table.GetPatchVertices(array, i),
                    &limit.position[leaf * terms * 3]);
            if (limit.has_uv)
                convert(conversions.of(array, i, index, true), stage.uvs, table.GetPatchFVarValues(array, i, 0),
                        &limit.uv[leaf * terms * 2]);
            insert(limit, place, ~std::int32_t(leaf));
        }
}

bool is_complete(const LimitPatches& limit, std::int32_t root) noexcept {
    if (root == missing_leaf) return false;
    if (root < 0) return true;
    const auto child = limit.nodes.begin() + 4 * root;
    for (int k = 0; k < 4; ++k) {
        const bool seen = std::find(child, child + k, child[k]) != child + k; // a strip is named twice
        if (!seen && !is_complete(limit, child[k])) return false;
    }
    return true;
}

} // namespace bake
