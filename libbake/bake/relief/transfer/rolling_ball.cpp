#include "bake/relief/transfer/rolling_ball.h"

namespace bake {
namespace {

constexpr double enough = 1e-4;     ///< of the radius, by which a ball may overlap what it touches
constexpr double opposite = -0.866; ///< cosine between facets with less than 30 degrees between them
constexpr double farthest = 6;      ///< radii from p to the centre
constexpr double inward = 1e-6;     ///< of a triangle, as an edge does not tell which of its sides a ball touches
constexpr int most_steps = 10;
constexpr std::size_t most_spaces = 8;
constexpr int halvings = 8, most_halvings = 40; ///< to find the radius of a ball that fits
constexpr double flat = 0.99996;                ///< cosine of half a degree
constexpr double same_point = 1e-5;             ///< of the radius
constexpr double unturned = 1 - 5e-7;           ///< cosine of .06 degrees

std::unique_ptr<TriangleTree> edge_tree(const Mesh& mesh, const std::vector<HardEdge>& edges, bool convex) {
    Mesh lines;
    std::vector<Triangle> thin;
    lines.positions = mesh.positions;
    for (const HardEdge& edge : edges) {
        if (edge.convex != convex) continue;
        const auto first = std::uint32_t(lines.corner_position.size());
        lines.corner_position.insert(lines.corner_position.end(), {edge.ends[0], edge.ends[1], edge.ends[1]});
        thin.push_back({{first, first + 1, first + 2}, std::uint32_t(thin.size())});
        lines.face_begin.push_back(first + 3);
    }
    return thin.empty() ? nullptr : std::make_unique<TriangleTree>(lines, thin);
}

/// A ball touches both facets of an edge at r tan(angle / 2) from it. Where several edges meet, it can be half as much more.
double reach_of(const std::vector<HardEdge>& edges, bool convex, double radius) {
    double reach = 0;
    for (const HardEdge& edge : edges)
        if (edge.convex == convex) reach = std::max(reach, 1.5 * std::tan(edge.angle / 2));
    return reach * radius;
}

bool is_inside(const NearestPoint& foot) noexcept { return std::min({foot.b1, foot.b2, 1 - foot.b1 - foot.b2}) > 1e-6; }

template <class T> Vec3d mixed(const T& a, const T& b, const T& c, double b1, double b2) noexcept {
    return (1 - b1 - b2) * Vec3d(a) + b1 * Vec3d(b) + b2 * Vec3d(c);
}

} // namespace

/// What a ball overlaps most.
struct RollingBall::Touch {
    std::uint32_t place; ///< in the tree
    Vec3d s, m;          ///< the point, and the normal there, away from the balls
    bool on_edge;        ///< the point lies on an edge of a flat triangle
};

RollingBall::RollingBall(const MeshSurface& surface, const SmoothPatches& patches, double radius)
    : surface_(surface), patches_(patches), radius_(std::min(radius, diagonal(bounds(*surface.mesh)))),
      tree_(*surface.mesh, surface.triangles), convex_(edge_tree(*surface.mesh, patches.edges(), true)),
      concave_(edge_tree(*surface.mesh, patches.edges(), false)),
      convex_reach_(reach_of(patches.edges(), true, radius_)),
      concave_reach_(reach_of(patches.edges(), false, radius_)), curved_(surface.triangles.size()) {
    facets_.reserve(curved_.size());
    for (const Triangle& t : surface.triangles) facets_.push_back(facet_normal(t));
    for (std::uint32_t t = 0; t < curved_.size(); ++t)
        for (const std::uint32_t corner : surface.triangles[t].corner)
            curved_[t] |= glm::dot(facets_[t], Vec3d(patches.normals()[corner])) < flat;
}

Vec3d RollingBall::facet_normal(const Triangle& triangle) const noexcept {
    const auto& corner = triangle.corner;
    const Mesh& mesh = *surface_.mesh;
    const auto at = [&](std::size_t k) { return Vec3d(mesh.positions[mesh.corner_position[corner[k]]]); };
    return unit_or_zero(glm::cross(at(1) - at(0), at(2) - at(0)));
}

bool RollingBall::is_near_edge(const TriangleTree* edges, double reach, const Vec3d& p) const noexcept {
    bool is_near = false;
    if (edges)
        edges->touching(Vec3f(p - reach), Vec3f(p + reach), 0, [&](std::uint32_t i) {
            is_near = is_near || edges->nearest_of(i, p).distance2 < reach * reach;
        });
    return is_near;
}

/// After the ball outside has rolled.
Vec3d RollingBall::filleted(const Vec3d& p, const Vec3d& n, std::uint32_t patch, bool& fits) const noexcept {
    return is_near_edge(concave_.get(), concave_reach_, p) ? -rounded({p, -n, -n, patch, Side::outside}, fits) : n;
}

RollingBall::Rounded RollingBall::at(std::uint32_t triangle, double b1, double b2) const noexcept {
    b1 += inward * (1.0 / 3 - b1), b2 += inward * (1.0 / 3 - b2);
    const auto& corner = surface_.triangles[triangle].corner;
    const Mesh& mesh = *surface_.mesh;
    const auto position = [&](std::size_t k) { return mesh.positions[mesh.corner_position[corner[k]]]; };
    const std::vector<Vec3f>& normals = patches_.normals();
    const Vec3d p = mixed(position(0), position(1), position(2), b1, b2);
    const Vec3d n = unit_or_zero(mixed(normals[corner[0]], normals[corner[1]], normals[corner[2]], b1, b2));
    Rounded out{.normal = n};
    if (n == Vec3d(0)) return out;
    const std::uint32_t patch = patches_.of_face(surface_.triangles[triangle].face);
    out.normal = filleted(p, n, patch, out.fits);
    if (is_near_edge(convex_.get(), convex_reach_, p))
        out.normal = rounded({p, n, out.normal, patch, Side::inside}, out.fits);
    out.tilted = glm::dot(out.normal, n) < unturned;
    return out;
}

Vec3d RollingBall::rounded(const Place& place, bool& fits) const noexcept {
    if (const auto centre = settle(place, radius_)) return -glm::normalize(*centre);
    fits = false;
    Vec3d best = place.turned;
    double least = 0, most = radius_;
    // Until a ball fits, and some steps more.
    for (int i = 0, fitting = 0; i < most_halvings && fitting < halvings; ++i) {
        const double radius = 0.5 * (least + most);
        const auto centre = settle(place, radius);
        if (centre) best = -glm::normalize(*centre), least = radius;
        else most = radius;
        fitting += least > 0;
    }
    return best;
}

std::optional<Vec3d> RollingBall::settle(const Place& place, double radius) const noexcept {
    std::array<HalfSpace, most_spaces> spaces;
    std::array<Touch, most_spaces> of;
    spaces[0] = {place.n, -radius}, of[0] = {no_index, place.p, place.n, false};
    std::size_t count = 1;
    Vec3d centre = -radius * place.n;
    for (int step = 0; step < most_steps; ++step) {
        const auto touch = nearest_touch(place, place.p + centre, radius);
        if (!touch) break;
        // A ball between two sheets is to become smaller, not to be pushed out where they part.
        if (glm::dot(touch->m, place.n) < opposite) return {};
        // A curved triangle that was met before is met at a better point.
        std::size_t i = 1;
        while (i < count && of[i].place != touch->place) ++i;
        if (i == most_spaces) i = 1 + std::size_t(step) % (most_spaces - 1);
        count = std::max(count, i + 1);
        spaces[i] = {touch->m, glm::dot(touch->m, touch->s - place.p) - radius}, of[i] = *touch;
        const auto better = nearest_to_zero({spaces.data(), count}, 1e-7 * radius);
        if (!better || glm::length(*better) > farthest * radius) return {};
        centre = *better;
    }
    if (!concave_ || place.side == Side::outside) return centre;
    // The same facets as the ball outside has left them.
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (glm::dot(spaces[i].a, centre) < spaces[i].c - enough * radius) continue;
        const Vec3d m = i == 0 ? place.turned : turned(of[i]);
        spaces[kept++] = {m, glm::dot(m, of[i].s - place.p) - radius};
    }
    return nearest_to_zero({spaces.data(), kept}, 1e-7 * radius);
}

Vec3d RollingBall::turned(const Touch& touch) const noexcept {
    if (touch.on_edge) return mean_normal(touch.s, same_point * radius_); // where the ball outside leaves its middle
    bool fits = true;
    return filleted(touch.s, touch.m, patches_.of_face(surface_.triangles[tree_.index(touch.place)].face), fits);
}

std::optional<RollingBall::Touch> RollingBall::nearest_touch(const Place& place, const Vec3d& q,
                                                             double radius) const noexcept {
    NearestPoint best;
    const double sign = place.side == Side::inside ? 1 : -1;
    const double within = (1 - enough) * radius;
    best.distance2 = within * within;
    const Vec3f low(q - radius), high(q + radius);
    tree_.touching(low, high, 0, [&](std::uint32_t i) {
        const std::uint32_t face = surface_.triangles[tree_.index(i)].face;
        if (!patches_.are_near(place.patch, patches_.of_face(face))) return;
        // The ball on the other side of the edge rolls on facets that p lies in front of.
        if (sign * glm::dot(facets_[tree_.index(i)], place.p - Vec3d(tree_.corners(i)[0])) > 1e-5 * radius_) return;
        const NearestPoint foot = tree_.nearest_of(i, q);
        if (foot.distance2 < best.distance2) best = foot;
    });
    if (best.triangle == no_index) return {};
    const std::uint32_t triangle = tree_.index(best.triangle);
    return Touch{best.triangle, best.point, tangent_normal(place, q, triangle, best),
                 !curved_[triangle] && !is_inside(best)};
}

/// Of what lies at the foot, the nearest point to q.
Vec3d RollingBall::tangent_normal(const Place& place, const Vec3d& q, std::uint32_t triangle,
                                  const NearestPoint& foot) const noexcept {
    const double sign = place.side == Side::inside ? 1 : -1;
    if (curved_[triangle] || is_inside(foot)) {
        Vec3d n = facets_[triangle];
        if (curved_[triangle]) {
            const auto& corner = surface_.triangles[triangle].corner;
            const std::vector<Vec3f>& normals = patches_.normals();
            n = unit_or_zero(mixed(normals[corner[0]], normals[corner[1]], normals[corner[2]], foot.b1, foot.b2));
        }
        return sign * n;
    }
    // On an edge or a corner that points to the ball, the surface is rounded; if the centre has left the body, it is to return.
    const Vec3d away = foot.point - q, mean = sign * mean_normal(foot.point, same_point * radius_);
    const Vec3d m = glm::dot(away, mean) > 0 ? unit_or_zero(away) : mean;
    return m == Vec3d(0) ? sign * facets_[triangle] : m;
}

/// Unit mean over the facets that a point belongs to.
Vec3d RollingBall::mean_normal(const Vec3d& at, double within) const noexcept {
    Vec3d sum(0);
    tree_.touching(Vec3f(at - within), Vec3f(at + within), 0, [&](std::uint32_t i) {
        if (tree_.nearest_of(i, at).distance2 <= within * within) sum += facets_[tree_.index(i)];
    });
    return unit_or_zero(sum);
}

} // namespace bake
