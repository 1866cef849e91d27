// The only file that includes CGAL: with CGAL the binary is GPL-3.0-or-later as a whole, and this file is compiled with
// -frounding-math, which interval arithmetic needs. Self intersections are searched in the triangle soup, so that
// non-manifold meshes can be audited too. Our tree finds the pairs whose boxes overlap; CGAL's exact predicates decide, and
// the half-edge structures of CGAL, which took ten times the memory of the mesh, are not used.
// With CGAL's box sweep and unsorted faces, the audit of a million triangles took 5 s of processor time, and 22 s if they
// were shuffled; with the tree both take 3 s.
#include "bake/mesh/check/mesh_audit.h"

#ifndef BAKE_WITH_CGAL

namespace bake {
MeshAudit audit(const Mesh&, const std::vector<Triangle>&) { return {}; }
std::uint64_t audit_memory(std::uint64_t, std::uint64_t) noexcept { return 0; }
} // namespace bake

#else

#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/mesh/check/closed_components.h"
#include "bake/mesh/triangle_tree.h"
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <algorithm>
#include <array>

namespace bake {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Point2 = Kernel::Point_2;
using Index = std::uint32_t;
using Corners = std::array<Vec3f, 3>;

constexpr Index batch = 1 << 16; // triangles between two looks whether the user asked to stop

Point point(const Vec3f& p) { return Point(p.x, p.y, p.z); }

/// Whether two triangles with area intersect beyond the corners that they share.
bool intersect(Corners s, Corners t) {
    // Reordered so that shared corners come first, in the same order in both.
    int shared = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = shared; j < 3; ++j)
            if (s[i] == t[j]) {
                std::swap(s[shared], s[i]);
                std::swap(t[shared], t[j]);
                ++shared;
                break;
            }
    if (shared == 3) return true; // the same triangle twice
    const Point p[3] = {point(s[0]), point(s[1]), point(s[2])}, q[3] = {point(t[0]), point(t[1]), point(t[2])};
    if (shared == 2)
        return CGAL::coplanar(p[0], p[1], p[2], q[2]) &&
               CGAL::coplanar_orientation(p[0], p[1], p[2], q[2]) == CGAL::POSITIVE;
    const CGAL::Orientation first_side = CGAL::orientation(p[0], p[1], p[2], q[2]);
    if (shared == 1) {
        // Most pairs of a fan end here: the opposite edge is on one side of the plane.
        if (first_side != CGAL::COPLANAR && first_side == CGAL::orientation(p[0], p[1], p[2], q[1])) return false;
        return CGAL::do_intersect(Kernel::Triangle_3(p[0], p[1], p[2]), Kernel::Segment_3(q[1], q[2])) ||
               CGAL::do_intersect(Kernel::Triangle_3(q[0], q[1], q[2]), Kernel::Segment_3(p[1], p[2]));
    }
    if (first_side != CGAL::COPLANAR && first_side == CGAL::orientation(p[0], p[1], p[2], q[1]) &&
        first_side == CGAL::orientation(p[0], p[1], p[2], q[0]))
        return false;
    return CGAL::do_intersect(Kernel::Triangle_3(p[0], p[1], p[2]), Kernel::Triangle_3(q[0], q[1], q[2]));
}

bool has_area(const Corners& c) { return !CGAL::collinear(point(c[0]), point(c[1]), point(c[2])); }

Vec3f low(const Corners& c) {
    return {std::min({c[0].x, c[1].x, c[2].x}), std::min({c[0].y, c[1].y, c[2].y}), std::min({c[0].z, c[1].z, c[2].z})};
}
Vec3f high(const Corners& c) {
    return {std::max({c[0].x, c[1].x, c[2].x}), std::max({c[0].y, c[1].y, c[2].y}), std::max({c[0].z, c[1].z, c[2].z})};
}

using Pair = std::array<Index, 2>; // the lower first

struct Cuts {
    std::size_t count = 0;
    Pair first = {no_index, no_index}; ///< triangles
    std::vector<Pair> components;      ///< that intersect each other
};

void sort_unique(std::vector<Pair>& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

Cuts find_cuts(const TriangleTree& tree, const std::vector<Index>& component) {
    std::vector<char> sound(tree.size());
    for_rows(tree.size(), 4096, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = Index(begin); i < end; ++i) sound[i] = has_area(tree.corners(i));
    });
    constexpr std::int64_t grain = 1024;
    std::vector<Cuts> parts((tree.size() + grain - 1) / grain);
    for_rows(tree.size(), grain, [&](std::int64_t begin, std::int64_t end) {
        Cuts& part = parts[begin / grain];
        for (auto i = Index(begin); i < end; ++i) {
            if (!sound[i]) continue;
            const Corners& c = tree.corners(i);
            tree.touching(low(c), high(c), i + 1, [&](Index j) {
                if (!sound[j] || !intersect(c, tree.corners(j))) return;
                ++part.count;
                const auto [a, b] = std::minmax({tree.index(i), tree.index(j)});
                part.first = std::min(part.first, Pair{a, b});
                const auto [k, l] = std::minmax({component[a], component[b]});
                if (k != l) part.components.push_back({k, l});
            });
        }
        sort_unique(part.components);
    });
    Cuts all;
    for (const Cuts& part : parts) {
        all.count += part.count;
        all.first = std::min(all.first, part.first);
        all.components.insert(all.components.end(), part.components.begin(), part.components.end());
    }
    sort_unique(all.components);
    return all;
}

/// A closed component.
struct Shell {
    Index component = 0, first = no_index; ///< its first triangle
    Vec3f low{0}, high{0};
    Vec3f top{0}; ///< a corner with the largest z
    double volume = 0;
    bool outward = false;
    std::size_t depth = 0; ///< number of shells that contain it
};

/// The boxes, top corners and volumes of the closed components. Volumes are sums over the triangles in their order.
std::vector<Shell> measure_shells(const TriangleTree& tree, const Components& components) {
    std::vector<Shell> shells(components.count());
    const Vec3d reference = tree.size() > 0 ? Vec3d(tree.corners(0)[0]) : Vec3d(0);
    for (Index place = 0; place < tree.size(); ++place) {
        if (place % batch == 0) throw_if_interrupted();
        const Index component = components.of[tree.index(place)];
        if (component == no_index || !components.closed[component]) continue;
        Shell& shell = shells[component];
        const Corners& c = tree.corners(place);
        if (shell.first == no_index) shell = {component, place, low(c), high(c), c[0]};
        shell.low = glm::min(shell.low, low(c)), shell.high = glm::max(shell.high, high(c));
        for (const Vec3f& p : c)
            if (p.z > shell.top.z) shell.top = p;
        const Vec3d a = Vec3d(c[0]) - reference, b = Vec3d(c[1]) - reference, d = Vec3d(c[2]) - reference;
        shell.volume += glm::dot(a, glm::cross(b, d)) / 6;
    }
    std::erase_if(shells, [](const Shell& shell) { return shell.first == no_index; });
    return shells;
}

/// A triangle at a shell's top corner, with the two other corners: it has the sides from -> top and top -> to.
struct TopTriangle {
    Vec3f from, to;
};

/// Whether the faces of a closed shell look outwards, by the triangles around a corner with the largest z: at the edge
/// with the least slope, the upper one of the two triangles decides, as in CGAL's is_outward_oriented().
bool looks_outward(const Vec3f& corner, const std::vector<TopTriangle>& around) {
    const Point top = point(corner);
    const TopTriangle* flattest = &around.front();
    for (const TopTriangle& t : around)
        if (CGAL::compare_slope(point(t.from), top, point(flattest->from), top) == CGAL::SMALLER) flattest = &t;
    // The other triangle at the edge has the side top -> from.
    const auto other =
        std::find_if(around.begin(), around.end(), [&](const TopTriangle& t) { return t.to == flattest->from; });
    if (other == around.end()) return false;
    const Point p = point(flattest->from), own = point(flattest->to), beyond = point(other->from);
    const auto seen_from_above = [](const Point& a, const Point& b, const Point& c) {
        return CGAL::orientation(Point2(a.x(), a.y()), Point2(b.x(), b.y()), Point2(c.x(), c.y()));
    };
    const CGAL::Orientation first = seen_from_above(p, top, own), second = seen_from_above(top, p, beyond);
    if (first == CGAL::COLLINEAR) return second == CGAL::LEFT_TURN;
    if (second == CGAL::COLLINEAR || first == second) return first == CGAL::LEFT_TURN;
    // Both triangles are on one side of the edge, one above the other.
    if (first == CGAL::LEFT_TURN) return CGAL::orientation(p, top, own, beyond) == CGAL::NEGATIVE;
    return CGAL::orientation(top, p, beyond, own) == CGAL::NEGATIVE;
}

void orient(std::vector<Shell>& shells, const TriangleTree& tree, const Components& components) {
    for_rows(std::int64_t(shells.size()), 64, [&](std::int64_t begin, std::int64_t end) {
        std::vector<TopTriangle> around;
        for (auto i = begin; i < end; ++i) {
            Shell& shell = shells[std::size_t(i)];
            around.clear();
            tree.touching(shell.top, shell.top, 0, [&](Index place) {
                if (components.of[tree.index(place)] != shell.component) return;
                const Corners& c = tree.corners(place);
                for (int k = 0; k < 3; ++k)
                    if (c[k] == shell.top) around.push_back({c[(k + 2) % 3], c[(k + 1) % 3]});
            });
            shell.outward = looks_outward(shell.top, around);
        }
    });
}

/// On which side of the line from a to b, seen from above, the point p is: 1 left, -1 right. A point on the line counts
/// as moved by (e, e^2) with e > 0 as small as needed, so that a point is never on an edge, and is inside exactly one of
/// two triangles that meet there. 0 if a is above b.
int side_of(const Vec3f& a, const Vec3f& b, const Vec3f& p) {
    const CGAL::Orientation side = CGAL::orientation(Point2(a.x, a.y), Point2(b.x, b.y), Point2(p.x, p.y));
    if (side != CGAL::COLLINEAR) return side == CGAL::LEFT_TURN ? 1 : -1;
    if (a.y != b.y) return a.y > b.y ? 1 : -1;
    return (b.x > a.x) - (b.x < a.x);
}

enum class Place { outside, inside, on };

/// Where a point lies with respect to a shell that it touches at common corners only: by the number of triangles above.
Place place_in(const Shell& shell, const Vec3f& p, const TriangleTree& tree, const Components& components) {
    bool on = false, inside = false;
    const Vec3f above(p.x, p.y, std::numeric_limits<float>::infinity());
    tree.touching(p, above, 0, [&](Index place) {
        if (on || components.of[tree.index(place)] != shell.component) return;
        const Corners& c = tree.corners(place);
        on = c[0] == p || c[1] == p || c[2] == p;
        const int turn = side_of(c[0], c[1], p);
        if (on || turn == 0 || side_of(c[1], c[2], p) != turn || side_of(c[2], c[0], p) != turn) return;
        const CGAL::Orientation side = CGAL::orientation(point(c[0]), point(c[1]), point(c[2]), point(p));
        on = side == CGAL::COPLANAR;
        inside ^= (side == CGAL::NEGATIVE) == (turn > 0);
    });
    return on ? Place::on : inside ? Place::inside : Place::outside;
}

bool contains(const Shell& outer, const Shell& inner) {
    return glm::min(outer.low, inner.low) == outer.low && glm::max(outer.high, inner.high) == outer.high;
}

/// Whether `inner` lies in `outer`. Shells may touch at vertices: the first vertex that is not on the other shell decides.
bool is_inside(const Shell& inner, const Shell& outer, const TriangleTree& tree, const Components& components) {
    for (Index place = inner.first; place < tree.size(); ++place) {
        if (components.of[tree.index(place)] != inner.component) continue;
        for (const Vec3f& p : tree.corners(place))
            if (const Place where = place_in(outer, p, tree, components); where != Place::on)
                return where == Place::inside;
    }
    return false;
}

/// Counts the shells around each shell. Shells that intersect are not nested.
void nest(std::vector<Shell>& shells, const std::vector<Pair>& cutting, const TriangleTree& tree,
          const Components& components) {
    for_rows(std::int64_t(shells.size()), 1, [&](std::int64_t i, std::int64_t) {
        Shell& inner = shells[std::size_t(i)];
        for (const Shell& outer : shells) {
            if (&inner == &outer || !contains(outer, inner)) continue;
            const auto [a, b] = std::minmax({inner.component, outer.component});
            if (std::binary_search(cutting.begin(), cutting.end(), Pair{a, b})) continue;
            inner.depth += is_inside(inner, outer, tree, components);
        }
    });
}

/// The pair with the lowest numbers, and the centre of the overlap of its boxes.
void report_first(MeshAudit& to, const Mesh& mesh, const std::vector<Triangle>& triangles, const Pair& pair) {
    Corners c[2];
    for (int i = 0; i < 2; ++i) {
        const Triangle& t = triangles[pair[i]];
        to.first_faces[i] = t.face;
        for (int k = 0; k < 3; ++k) c[i][k] = mesh.positions[mesh.corner_position[t.corner[k]]];
    }
    for (int k = 0; k < 3; ++k)
        to.first_place[k] =
            0.5 * (double(std::max(low(c[0])[k], low(c[1])[k])) + double(std::min(high(c[0])[k], high(c[1])[k])));
}

} // namespace

MeshAudit audit(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    MeshAudit result;
    result.available = true;
    const Components components = find_components(welded_corners(mesh, triangles), Index(mesh.positions.size()));
    const TriangleTree tree(mesh, triangles);
    const Cuts cuts = find_cuts(tree, components.of);
    result.self_intersections = cuts.count;
    if (cuts.count > 0) report_first(result, mesh, triangles, cuts.first);

    std::vector<Shell> shells = measure_shells(tree, components);
    orient(shells, tree, components);
    nest(shells, cuts.components, tree, components);
    for (const Shell& shell : shells) {
        const bool wall = shell.depth % 2 == 1;
        result.nested_components += wall;
        result.inverted_components += shell.outward == wall;
        result.volume += shell.volume;
    }
    result.components = components.count();
    result.closed_components = shells.size();
    result.closed = result.components > 0 && shells.size() == result.components;
    result.outward = result.closed && result.inverted_components == 0;
    result.bounds_volume = result.outward && result.self_intersections == 0;
    return result;
}

std::uint64_t audit_memory(std::uint64_t positions, std::uint64_t triangles) noexcept {
    const std::uint64_t list = triangles * sizeof(Triangle);
    const std::uint64_t component = triangles * sizeof(Index), sound = triangles;
    return list +
           std::max(components_memory(positions, triangles), component + sound + TriangleTree::memory(triangles));
}

} // namespace bake

#endif
