// The one file that sees CGAL: with it the binary is GPL-3.0-or-later as a whole, and this file is compiled with
// -frounding-math, which interval arithmetic needs. Self intersections are looked for in the soup, so that meshes no
// half-edge structure can hold are audited too: candidates by CGAL's box sweep, decisions by its exact predicates.
#include "bake/surface/mesh_audit.h"

#ifndef BAKE_WITH_CGAL

namespace bake {
MeshAudit audit(const Mesh&, const std::vector<Triangle>&) { return {}; }
} // namespace bake

#else

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>
#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace bake {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Corners = std::array<std::size_t, 3>;

struct Soup {
    std::vector<Point> points;      ///< bit-equal positions are one
    std::vector<Corners> triangles; ///< without those that use a point twice
};

Soup make_soup(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    Soup soup;
    std::map<std::tuple<float, float, float>, std::size_t> known;
    const auto point = [&](std::uint32_t corner) {
        const Vec3f& p = mesh.positions[mesh.corner_position[corner]];
        const auto [at, fresh] = known.try_emplace({p.x, p.y, p.z}, soup.points.size());
        if (fresh) soup.points.emplace_back(p.x, p.y, p.z);
        return at->second;
    };
    for (const Triangle& t : triangles) {
        const Corners c = {point(t.corner[0]), point(t.corner[1]), point(t.corner[2])};
        if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) soup.triangles.push_back(c);
    }
    return soup;
}

// Whether two triangles meet elsewhere than in the points they share.
bool intersect(const Soup& soup, const Corners& a, const Corners& b) {
    // Turned so that shared points come first, in the same order in both.
    Corners s = a, t = b;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = shared; j < 3; ++j)
            if (s[i] == t[j]) {
                std::swap(s[shared], s[i]);
                std::swap(t[shared], t[j]);
                ++shared;
                break;
            }
    const auto p = [&](std::size_t i) -> const Point& { return soup.points[s[i]]; };
    const auto q = [&](std::size_t i) -> const Point& { return soup.points[t[i]]; };
    const Kernel::Triangle_3 first(p(0), p(1), p(2)), second(q(0), q(1), q(2));
    switch (shared) {
    case 0: return CGAL::do_intersect(first, second);
    case 1:
        return CGAL::do_intersect(first, Kernel::Segment_3(q(1), q(2))) ||
               CGAL::do_intersect(second, Kernel::Segment_3(p(1), p(2)));
    case 2:
        return CGAL::coplanar(p(0), p(1), p(2), q(2)) &&
               CGAL::coplanar_orientation(p(0), p(1), p(2), q(2)) == CGAL::POSITIVE;
    default: return true; // the same triangle twice
    }
}

std::size_t count_self_intersections(const Soup& soup) {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
        const auto& [a, b, c] = soup.triangles[i];
        const Point &p = soup.points[a], &q = soup.points[b], &r = soup.points[c];
        if (!CGAL::collinear(p, q, r)) boxes.emplace_back(p.bbox() + q.bbox() + r.bbox(), i);
    }
    std::size_t count = 0;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        count += intersect(soup, soup.triangles[a.info()], soup.triangles[b.info()]);
    });
    return count;
}

} // namespace

MeshAudit audit(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    MeshAudit result;
    result.available = true;
    const Soup soup = make_soup(mesh, triangles);
    result.self_intersections = count_self_intersections(soup);
    if (soup.triangles.empty() || !pmp::is_polygon_soup_a_polygon_mesh(soup.triangles)) return result;

    CGAL::Surface_mesh<Point> surface;
    pmp::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, surface);
    result.closed = CGAL::is_closed(surface);
    if (!result.closed) return result;
    result.volume = CGAL::to_double(pmp::volume(surface));
    // Nesting of shells is defined only while none cuts another.
    result.outward =
        pmp::is_outward_oriented(surface) && (result.self_intersections > 0 || pmp::does_bound_a_volume(surface));
    return result;
}

} // namespace bake

#endif
