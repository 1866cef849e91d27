#include "bake/surface/subdivision/stage.h"
#include "bake/base/vec.h"
#include "bake/surface/subdivision/conversion.h"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <tuple>

namespace bake {
namespace {

using namespace OpenSubdiv;

constexpr std::int32_t missing = std::numeric_limits<std::int32_t>::min();

// Where a face of some level or a leaf lies: in which patch, with which parameters, how deep.
struct Place {
    std::int32_t patch = -1;
    LimitLeaf leaf{1, Vec2d(0)};
    int depth = 0;
};

// `inner` is a place within a face that lies at `outer`.
Place within(const Place& outer, const Place& inner) {
    return {outer.patch,
            {outer.leaf.scale * inner.leaf.scale, inner.leaf.scale * outer.leaf.origin + inner.leaf.origin},
            outer.depth + inner.depth};
}

Place place_of(const Far::PatchParam& param, bool triangles) {
    const int depth = param.GetDepth() - param.NonQuadRoot();
    const double parts = double(1 << depth);
    if (triangles && param.IsTriangleRotated())
        return {-1, {-parts, Vec2d(parts - param.GetU(), parts - param.GetV())}, depth};
    return {-1, {parts, Vec2d(-double(param.GetU()), -double(param.GetV()))}, depth};
}

// Child k of a quad or triangle, in Far's order.
Place child_place(bool triangles, int k) {
    if (triangles && k == 3) return {-1, {-2, Vec2d(1)}, 1};
    const bool right = k == 1 || (k == 2 && !triangles), up = k >= 2;
    return {-1, {2, -Vec2d(right, up)}, 1};
}

// A cage, or what is left of one: points and topology, and where its faces lie.
struct Stage {
    std::unique_ptr<Far::TopologyRefiner> refiner;
    std::vector<Weighed<Vec3d>> points;
    std::vector<Weighed<Vec2d>> uvs;
    std::vector<Place> places; ///< of each patch of level 0, as Far numbers them
    std::vector<int> first;    ///< of each face of level 0: its first place
    std::vector<int> faces;    ///< those to make patches of; none: all
    int levels = 0;            ///< that this stage splits
    int level = 0;             ///< down to which that leads
};

Stage first_stage(const Mesh& cage, const SubdivisionOptions& options, LimitPatches& limit) {
    Stage stage;
    UvValues uvs = uv_values(cage);
    limit.has_uv = !uvs.corner.empty();
    stage.refiner = make_refiner(refiner_input(cage, uvs), cage.tags.boundary, options);
    for (const Vec3f& p : cage.positions) stage.points.push_back({Vec3d(p)});
    stage.uvs = std::move(uvs.values);
    stage.levels = stage.level = options.isolation;
    for (std::uint32_t f = 0; f < cage.faces(); ++f) {
        const std::uint32_t size = cage.face_begin[f + 1] - cage.face_begin[f];
        const std::uint32_t patches = limit.triangles || size == 4 ? 1 : size;
        stage.first.push_back(int(limit.patches.size()));
        for (std::uint32_t corner = 0; corner < patches; ++corner) {
            stage.places.push_back({std::int32_t(limit.patches.size())});
            limit.patches.push_back({f, corner, missing});
        }
    }
    return stage;
}

std::unique_ptr<Far::PatchTable> split(Stage& stage, bool uvs, int sharp_levels) {
    Far::PatchTableFactory::Options options(unsigned(std::max(stage.levels, sharp_levels)));
    options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    options.SetPatchPrecision<double>();
    options.SetFVarPatchPrecision<double>();
    options.useInfSharpPatch = true;
    options.generateVaryingTables = false;
    options.generateFVarTables = uvs;
    options.generateFVarLegacyLinearPatches = false;
    options.generateLegacySharpCornerPatches = false; // or smooth corners of the border would be taken for sharp ones
    Far::TopologyRefiner::AdaptiveOptions adaptive = options.GetRefineAdaptiveOptions();
    adaptive.SetSecondaryLevel(stage.levels);
    const Far::ConstIndexArray faces(stage.faces.data(), int(stage.faces.size()));
    stage.refiner->RefineAdaptive(adaptive, faces);
    return std::unique_ptr<Far::PatchTable>(Far::PatchTableFactory::Create(*stage.refiner, options, faces));
}

// Control points of every level, and the ends' own after them.
template <class V>
std::vector<Weighed<V>> refine_points(const Far::TopologyRefiner& refiner, std::vector<Weighed<V>> base,
                                      const Far::StencilTableReal<double>* ends, bool face_varying) {
    const int total = face_varying ? refiner.GetNumFVarValuesTotal(0) : refiner.GetNumVerticesTotal();
    const int own = ends ? ends->GetNumStencils() : 0;
    std::vector<Weighed<V>> points = std::move(base);
    points.resize(std::size_t(total + own));
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    Weighed<V>* from = points.data();
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
        const Far::TopologyLevel& above = refiner.GetLevel(level - 1);
        Weighed<V>* to = from + (face_varying ? above.GetNumFVarValues(0) : above.GetNumVertices());
        if (face_varying) primvars.InterpolateFaceVarying(level, from, to, 0);
        else primvars.Interpolate(level, from, to);
        from = to;
    }
    if (own > 0) ends->UpdateValues(points.data(), points.data() + total);
    return points;
}

void insert_leaf(LimitPatches& limit, const Place& place, std::int32_t leaf) {
    std::int32_t* link = &limit.patches[std::size_t(place.patch)].root;
    const Vec2d centre = (Vec2d(limit.triangles ? 1.0 / 3 : 0.5) - place.leaf.origin) / place.leaf.scale;
    double s = centre.x, t = centre.y;
    for (int depth = 0; depth < place.depth; ++depth) {
        if (*link == missing) {
            *link = std::int32_t(limit.nodes.size() / 4);
            const std::int32_t node = *link;
            limit.nodes.insert(limit.nodes.end(), 4, missing); // moves what link points at
            link = &limit.nodes[std::size_t(4 * node + step_into_child(limit.triangles, s, t))];
        } else {
            link = &limit.nodes[std::size_t(4 * *link + step_into_child(limit.triangles, s, t))];
        }
    }
    *link = ~leaf;
}

bool is_irregular(const Far::PatchTable& table, int array) {
    return table.GetPatchArrayDescriptor(array).GetType() >= Far::PatchDescriptor::GREGORY;
}

// Where the faces of the last level lie.
std::vector<Place> last_places(const Stage& stage, bool triangles) {
    const Far::TopologyRefiner& refiner = *stage.refiner;
    std::vector<Place> places;
    for (int level = 0; level < refiner.GetMaxLevel(); ++level) {
        const Far::TopologyLevel& faces = refiner.GetLevel(level);
        std::vector<Place> next(std::size_t(refiner.GetLevel(level + 1).GetNumFaces()));
        for (int f = 0; f < faces.GetNumFaces(); ++f) {
            const Far::ConstIndexArray children = faces.GetFaceChildFaces(f);
            const bool whole = triangles || faces.GetFaceVertices(f).size() == 4;
            for (int k = 0; k < children.size(); ++k) {
                if (children[k] < 0) continue;
                Place& child = next[std::size_t(children[k])];
                if (level > 0) child = within(places[std::size_t(f)], child_place(triangles, k));
                else if (whole)
                    child = within(stage.places[std::size_t(stage.first[std::size_t(f)])], child_place(triangles, k));
                else child = stage.places[std::size_t(stage.first[std::size_t(f)] + k)];
            }
        }
        places = std::move(next);
    }
    return places;
}

// Corners that no crease, corner or border ends at: where the surface has a tangent plane to turn to.
bool is_smooth(const Far::TopologyLevel& level, int face) {
    for (const Far::Index v : level.GetFaceVertices(face)) {
        if (level.IsVertexBoundary(v) || level.GetVertexSharpness(v) > 0) return false;
        for (const Far::Index e : level.GetVertexEdges(v))
            if (level.GetEdgeSharpness(e) > 0) return false;
    }
    return true;
}

// Largest angle between a facet and those beside it. `points` are the level's own.
double turn_deg(const Far::TopologyLevel& level, int face, const Weighed<Vec3d>* points) {
    const auto normal = [&](int f) {
        const Far::ConstIndexArray c = level.GetFaceVertices(f);
        const auto at = [&](int k) { return points[c[k]].value; };
        return c.size() == 3 ? glm::cross(at(1) - at(0), at(2) - at(0)) : glm::cross(at(2) - at(0), at(3) - at(1));
    };
    const Vec3d own = normal(face);
    double most = 0;
    for (const Far::Index e : level.GetFaceEdges(face))
        for (const Far::Index f : level.GetEdgeFaces(e)) {
            if (f == face) continue;
            const Vec3d other = normal(f);
            most = std::max(most, std::atan2(glm::length(glm::cross(own, other)), glm::dot(own, other)));
        }
    return most * 180 / pi;
}

// What is small enough not to be split on.
struct Enough {
    double size;    ///< of any piece
    double turning; ///< of one that turns
};

// Faces of the last level that irregular patches stand for and that are to be split on: those that are not small enough,
// and all round a vertex with one of them, so that they keep meeting. Faces of the last level, by the patches' order
// in the table; -1 for patches that become leaves.
std::vector<int> faces_to_split(const Stage& stage, const Far::PatchTable& table, const std::vector<Place>& places,
                                const std::vector<Weighed<Vec3d>>& points, const Enough& enough, bool triangles) {
    const auto key = [](const Place& place) {
        return std::tuple(place.patch, place.leaf.origin.x, place.leaf.origin.y);
    };
    std::vector<int> by_key(places.size());
    std::iota(by_key.begin(), by_key.end(), 0);
    std::sort(by_key.begin(), by_key.end(),
              [&](int f, int g) { return key(places[std::size_t(f)]) < key(places[std::size_t(g)]); });
    const Far::TopologyLevel& last = stage.refiner->GetLevel(stage.refiner->GetMaxLevel());
    const int first_point = stage.refiner->GetNumVerticesTotal() - last.GetNumVertices();

    std::vector<int> faces;
    std::vector<char> large_at(std::size_t(last.GetNumVertices()), 0);
    for (int array = 0; array < table.GetNumPatchArrays(); ++array)
        for (int i = 0; i < table.GetNumPatches(array); ++i) {
            faces.push_back(-1);
            if (!is_irregular(table, array)) continue;
            const Far::PatchParam param = table.GetPatchParam(array, i);
            const Place place = within(stage.places[std::size_t(param.GetFaceId())], place_of(param, triangles));
            const auto found = std::lower_bound(by_key.begin(), by_key.end(), key(place),
                                                [&](int f, const auto& k) { return key(places[std::size_t(f)]) < k; });
            assert(found != by_key.end() && key(places[std::size_t(*found)]) == key(place));
            faces.back() = *found;
            const Far::ConstIndexArray corners = last.GetFaceVertices(*found);
            double size = 0;
            for (const Far::Index v : corners)
                size = std::max(size, glm::distance(points[std::size_t(first_point + v)].value,
                                                    points[std::size_t(first_point + corners[0])].value));
            if (size > enough.size || (size > enough.turning && is_smooth(last, *found) &&
                                       turn_deg(last, *found, &points[std::size_t(first_point)]) > most_turn_deg))
                for (const Far::Index v : corners) large_at[std::size_t(v)] = 1;
        }
    for (int& f : faces) {
        if (f < 0) continue;
        const Far::ConstIndexArray corners = last.GetFaceVertices(f);
        if (std::none_of(corners.begin(), corners.end(), [&](Far::Index v) { return large_at[std::size_t(v)]; }))
            f = -1;
    }
    return faces;
}

// Patches become leaves, but for those of faces that are split on (faces_to_split; none when there are none).
void add_leaves(const Stage& stage, const Far::PatchTable& table, const std::vector<Weighed<Vec3d>>& points,
                const std::vector<Weighed<Vec2d>>& uvs, const std::vector<int>& split_on, LimitPatches& limit) {
    Conversions conversions(table, limit.triangles);
    const auto terms = std::size_t(limit.terms());
    const std::size_t most = limit.leaves.size() + std::size_t(table.GetNumPatchesTotal());
    if (most > limit.leaves.capacity()) {
        // Room for the stages that follow: not touched it costs nothing, and moving all that is there costs much.
        const std::size_t room = most + most / 2;
        limit.leaves.reserve(room);
        limit.position.reserve(room * terms * 3);
        limit.uv.reserve(limit.has_uv ? room * terms * 2 : 0);
    }
    int index = 0;
    for (int array = 0; array < table.GetNumPatchArrays(); ++array)
        for (int i = 0; i < table.GetNumPatches(array); ++i, ++index) {
            if (!split_on.empty() && split_on[std::size_t(index)] >= 0) continue;
            const std::size_t leaf = limit.leaves.size();
            limit.position.resize((leaf + 1) * terms * 3);
            convert(conversions.of(array, i, index, false), points, table.GetPatchVertices(array, i),
                    &limit.position[leaf * terms * 3]);
            if (limit.has_uv) {
                limit.uv.resize((leaf + 1) * terms * 2);
                convert(conversions.of(array, i, index, true), uvs, table.GetPatchFVarValues(array, i, 0),
                        &limit.uv[leaf * terms * 2]);
            }
            const Far::PatchParam param = table.GetPatchParam(array, i);
            const Place place = within(stage.places[std::size_t(param.GetFaceId())], place_of(param, limit.triangles));
            limit.leaves.push_back(place.leaf);
            insert_leaf(limit, place, std::int32_t(leaf));
        }
}

// Numbers old indices in the order in which they are first met.
class Renumbering {
public:
    explicit Renumbering(int count) : number_(std::size_t(count), -1) {}
    int of(int old) {
        int& number = number_[std::size_t(old)];
        if (number < 0) {
            number = int(olds.size());
            olds.push_back(old);
        }
        return number;
    }
    std::vector<int> olds;

private:
    std::vector<int> number_;
};

// The last level's faces that are split on and those that touch them, as a cage. Borders of this cut are not the
// surface's, but lie too far away to be felt in the patches asked for.
Stage next_stage(const Stage& stage, const std::vector<int>& split_on, const std::vector<Place>& places,
                 const std::vector<Weighed<Vec3d>>& points, const std::vector<Weighed<Vec2d>>& uvs,
                 const SubdivisionOptions& options, const LimitPatches& limit) {
    const Far::TopologyRefiner& refiner = *stage.refiner;
    const Far::TopologyLevel& last = refiner.GetLevel(refiner.GetMaxLevel());
    const int first_point = refiner.GetNumVerticesTotal() - last.GetNumVertices();

    Stage next;
    std::vector<char> is_wanted(places.size(), 0), near(std::size_t(last.GetNumVertices()), 0);
    for (const int f : split_on) {
        if (f < 0) continue;
        is_wanted[std::size_t(f)] = 1;
        for (const Far::Index v : last.GetFaceVertices(f)) near[std::size_t(v)] = 1;
    }
    RefinerInput cage;
    Renumbering vertices(last.GetNumVertices()), values(limit.has_uv ? last.GetNumFVarValues(0) : 0);
    std::vector<char> edge_done(std::size_t(last.GetNumEdges()), 0);
    for (int f = 0; f < last.GetNumFaces(); ++f) {
        const Far::ConstIndexArray corners = last.GetFaceVertices(f);
        if (std::none_of(corners.begin(), corners.end(), [&](Far::Index v) { return near[std::size_t(v)]; })) continue;
        if (is_wanted[std::size_t(f)]) next.faces.push_back(int(cage.sizes.size()));
        next.first.push_back(int(next.places.size()));
        next.places.push_back(places[std::size_t(f)]);
        cage.sizes.push_back(corners.size());
        for (const Far::Index v : corners) cage.corner_position.push_back(vertices.of(v));
        if (limit.has_uv)
            for (const Far::Index v : last.GetFaceFVarValues(f, 0)) cage.corner_uv.push_back(values.of(v));
        for (const Far::Index e : last.GetFaceEdges(f)) {
            if (last.GetEdgeSharpness(e) == 0 || edge_done[std::size_t(e)]) continue;
            edge_done[std::size_t(e)] = 1;
            const Far::ConstIndexArray ends = last.GetEdgeVertices(e);
            cage.creases.insert(cage.creases.end(), {vertices.of(ends[0]), vertices.of(ends[1])});
            cage.crease_weights.push_back(last.GetEdgeSharpness(e));
        }
    }
    for (std::size_t v = 0; v < vertices.olds.size(); ++v) {
        next.points.push_back(points[std::size_t(first_point + vertices.olds[v])]);
        if (last.GetVertexSharpness(vertices.olds[v]) == 0) continue;
        cage.corners.push_back(int(v));
        cage.corner_weights.push_back(last.GetVertexSharpness(vertices.olds[v]));
    }
    cage.positions = int(next.points.size());
    if (limit.has_uv) {
        const int first_value = refiner.GetNumFVarValuesTotal(0) - last.GetNumFVarValues(0);
        for (const int old : values.olds) next.uvs.push_back(uvs[std::size_t(first_value + old)]);
        cage.uvs = int(next.uvs.size());
    }
    next.refiner = make_refiner(cage, SubdivisionTags::Boundary::edge_only, options);
    next.levels = further_levels;
    next.level = stage.level + next.levels;
    return next;
}

bool has_irregular(const Far::PatchTable& table) {
    for (int array = 0; array < table.GetNumPatchArrays(); ++array)
        if (is_irregular(table, array) && table.GetNumPatches(array) > 0) return true;
    return false;
}

bool is_complete(const LimitPatches& limit, std::int32_t root) noexcept {
    if (root == missing) return false;
    if (root < 0) return true;
    for (int child = 0; child < 4; ++child)
        if (!is_complete(limit, limit.nodes[std::size_t(4 * root + child)])) return false;
    return true;
}

// Semi-sharp creases and corners are split as long as they are.
int sharp_levels(const SubdivisionTags& tags) noexcept {
    float sharpest = 0;
    for (const auto& crease : tags.creases)
        if (crease.sharpness < 10) sharpest = std::max(sharpest, crease.sharpness);
    for (const auto& corner : tags.corners)
        if (corner.sharpness < 10) sharpest = std::max(sharpest, corner.sharpness);
    return int(std::ceil(sharpest));
}

} // namespace

void make_patches(const Mesh& cage, const SubdivisionOptions& options, LimitPatches& limit) {
    limit.triangles = options.scheme == Scheme::loop;
    Stage stage = first_stage(cage, options, limit);
    const double size = diagonal(bounds(cage));
    for (int sharp = sharp_levels(cage.tags);; sharp = 0) {
        const auto table = split(stage, limit.has_uv, sharp);
        const auto points =
            refine_points(*stage.refiner, std::move(stage.points), table->GetLocalPointStencilTable<double>(), false);
        std::vector<Weighed<Vec2d>> uvs;
        if (limit.has_uv)
            uvs = refine_points(*stage.refiner, std::move(stage.uvs),
                                table->GetLocalPointFaceVaryingStencilTable<double>(0), true);
        const int next_level = stage.level + further_levels;
        const bool may_go_on = options.isolation == stage_levels && next_level <= most_turning_levels;
        std::vector<int> split_on;
        std::vector<Place> places;
        if (may_go_on && has_irregular(*table)) {
            places = last_places(stage, limit.triangles);
            const Enough enough{next_level <= most_levels ? smallest_irregular * size : HUGE_VAL,
                                smallest_turning * size};
            split_on = faces_to_split(stage, *table, places, points, enough, limit.triangles);
        }
        add_leaves(stage, *table, points, uvs, split_on, limit);
        if (std::all_of(split_on.begin(), split_on.end(), [](int f) { return f < 0; })) break;
        stage = next_stage(stage, split_on, places, points, uvs, options, limit);
    }
    // Faces at a border that is not followed have no surface.
    std::erase_if(limit.patches, [&](const LimitPatch& patch) { return !is_complete(limit, patch.root); });
}

} // namespace bake
