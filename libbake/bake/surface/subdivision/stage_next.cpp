// The faces of a stage that need further refinement, as the cage of the next stage.
#include "bake/surface/subdivision/stage.h"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <tuple>

namespace bake {
namespace {

using namespace OpenSubdiv;

// The last level of a stage with its points and uvs.
struct LastLevel {
    const Far::TopologyLevel& level;
    const Weighted<Vec3d>* points;
    const Weighted<Vec2d>* uvs;
};

LastLevel last_level(const Stage& stage, bool has_uv) {
    const Far::TopologyRefiner& refiner = *stage.refiner;
    const Far::TopologyLevel& last = refiner.GetLevel(refiner.GetMaxLevel());
    return {last, stage.points.data() + (refiner.GetNumVerticesTotal() - last.GetNumVertices()),
            has_uv ? stage.uvs.data() + (refiner.GetNumFVarValuesTotal(0) - last.GetNumFVarValues(0)) : nullptr};
}

// True if no crease, corner or border ends at a vertex of the face. Only there does the surface have a tangent plane.
bool is_smooth(const Far::TopologyLevel& level, int face) {
    for (const Far::Index v : level.GetFaceVertices(face)) {
        if (level.IsVertexBoundary(v) || level.GetVertexSharpness(v) > 0) return false;
        for (const Far::Index e : level.GetVertexEdges(v))
            if (level.GetEdgeSharpness(e) > 0) return false;
    }
    return true;
}

// Largest angle between the facet and its neighbours.
double turn_deg(const LastLevel& last, int face) {
    const auto normal = [&](int f) {
        const Far::ConstIndexArray c = last.level.GetFaceVertices(f);
        const auto at = [&](int k) { return last.points[c[k]].value; };
        return c.size() == 3 ? glm::cross(at(1) - at(0), at(2) - at(0)) : glm::cross(at(2) - at(0), at(3) - at(1));
    };
    const Vec3d own = normal(face);
    double most = 0;
    for (const Far::Index e : last.level.GetFaceEdges(face))
        for (const Far::Index f : last.level.GetEdgeFaces(e)) {
            if (f == face) continue;
            const Vec3d other = normal(f);
            most = std::max(most, std::atan2(glm::length(glm::cross(own, other)), glm::dot(own, other)));
        }
    return most * 180 / pi;
}

bool is_too_large(const Stage& stage, const LastLevel& last, int face, double diagonal) {
    const Far::ConstIndexArray corners = last.level.GetFaceVertices(face);
    double size = 0;
    for (const Far::Index v : corners)
        size = std::max(size, glm::distance(last.points[v].value, last.points[corners[0]].value));
    if (stage.total_levels + further_levels <= most_size_levels && size > smallest_irregular * diagonal) return true;
    return size > smallest_turning * diagonal && is_smooth(last.level, face) && turn_deg(last, face) > most_turn_deg;
}

// Finds faces by their subdomains.
class FaceOfSubdomain {
public:
    explicit FaceOfSubdomain(const std::vector<Subdomain>& subdomains)
        : subdomains_(subdomains), sorted_(subdomains.size()) {
        std::iota(sorted_.begin(), sorted_.end(), 0);
        std::sort(sorted_.begin(), sorted_.end(), [&](int f, int g) { return key(f) < key(g); });
    }
    int find(const Subdomain& wanted) const {
        const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), key(wanted),
                                            [&](int f, const auto& k) { return key(f) < k; });
        assert(found != sorted_.end() && key(*found) == key(wanted));
        return *found;
    }

private:
    static std::tuple<std::int32_t, double, double> key(const Subdomain& s) {
        return {s.patch, s.leaf.origin.x, s.leaf.origin.y};
    }
    std::tuple<std::int32_t, double, double> key(int face) const { return key(subdomains_[std::size_t(face)]); }

    const std::vector<Subdomain>& subdomains_;
    std::vector<int> sorted_;
};

// Numbers old indices in the order of their first use.
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

bool any_vertex(const Far::TopologyLevel& level, int face, const std::vector<char>& marked) {
    const Far::ConstIndexArray corners = level.GetFaceVertices(face);
    return std::any_of(corners.begin(), corners.end(), [&](Far::Index v) { return marked[std::size_t(v)]; });
}

// Copies the creases of a face.
void add_creases(const Far::TopologyLevel& level, int face, Renumbering& vertices, std::vector<char>& edge_done,
                 RefinerInput& cage) {
    for (const Far::Index e : level.GetFaceEdges(face)) {
        if (level.GetEdgeSharpness(e) == 0 || edge_done[std::size_t(e)]) continue;
        edge_done[std::size_t(e)] = 1;
        const Far::ConstIndexArray ends = level.GetEdgeVertices(e);
        cage.creases.insert(cage.creases.end(), {vertices.of(ends[0]), vertices.of(ends[1])});
        cage.crease_weights.push_back(level.GetEdgeSharpness(e));
    }
}

} // namespace

bool is_irregular(const Far::PatchTable& table, int array) {
    return table.GetPatchArrayDescriptor(array).GetType() >= Far::PatchDescriptor::GREGORY;
}

std::vector<int> faces_to_refine(const Stage& stage, const Far::PatchTable& table, const std::vector<Subdomain>& last,
                                 double diagonal, bool triangles) {
    const FaceOfSubdomain face_of(last);
    const LastLevel level = last_level(stage, false);
    std::vector<int> faces;
    std::vector<char> too_large(std::size_t(level.level.GetNumVertices()), 0); // vertices of faces that are too large
    for (int array = 0; array < table.GetNumPatchArrays(); ++array)
        for (int i = 0; i < table.GetNumPatches(array); ++i) {
            faces.push_back(-1);
            if (!is_irregular(table, array)) continue;
            faces.back() = face_of.find(subdomain_of(stage, table.GetPatchParam(array, i), triangles));
            if (!is_too_large(stage, level, faces.back(), diagonal)) continue;
            for (const Far::Index v : level.level.GetFaceVertices(faces.back())) too_large[std::size_t(v)] = 1;
        }
    for (int& f : faces)
        if (f >= 0 && !any_vertex(level.level, f, too_large)) f = -1;
    return faces;
}

Stage next_stage(const Stage& stage, const std::vector<int>& to_refine, const std::vector<Subdomain>& last,
                 const SubdivisionOptions& options, const LimitPatches& limit) {
    const LastLevel from = last_level(stage, limit.has_uv);
    const Far::TopologyLevel& level = from.level;
    std::vector<char> is_wanted(last.size(), 0), near(std::size_t(level.GetNumVertices()), 0);
    for (const int f : to_refine) {
        if (f < 0) continue;
        is_wanted[std::size_t(f)] = 1;
        for (const Far::Index v : level.GetFaceVertices(f)) near[std::size_t(v)] = 1;
    }
    Stage next;
    RefinerInput cage;
    Renumbering vertices(level.GetNumVertices()), values(limit.has_uv ? level.GetNumFVarValues(0) : 0);
    std::vector<char> edge_done(std::size_t(level.GetNumEdges()), 0);
    for (int f = 0; f < level.GetNumFaces(); ++f) {
        if (!any_vertex(level, f, near)) continue;
        if (is_wanted[std::size_t(f)]) next.faces.push_back(int(cage.sizes.size()));
        next.first.push_back(int(next.subdomains.size()));
        next.subdomains.push_back(last[std::size_t(f)]);
        const Far::ConstIndexArray corners = level.GetFaceVertices(f);
        cage.sizes.push_back(corners.size());
        for (const Far::Index v : corners) cage.corner_position.push_back(vertices.of(v));
        if (limit.has_uv)
            for (const Far::Index v : level.GetFaceFVarValues(f, 0)) cage.corner_uv.push_back(values.of(v));
        add_creases(level, f, vertices, edge_done, cage);
    }
    for (std::size_t v = 0; v < vertices.olds.size(); ++v) {
        const int old = vertices.olds[v];
        next.points.push_back(from.points[old]);
        if (level.GetVertexSharpness(old) == 0) continue;
        cage.corners.push_back(int(v));
        cage.corner_weights.push_back(level.GetVertexSharpness(old));
    }
    for (const int old : values.olds) next.uvs.push_back(from.uvs[old]);
    cage.positions = int(next.points.size());
    cage.uvs = int(next.uvs.size());
    next.refiner = make_refiner(cage, SubdivisionTags::Boundary::edge_only, options);
    next.levels = further_levels;
    next.total_levels = stage.total_levels + next.levels;
    return next;
}

} // namespace bake
