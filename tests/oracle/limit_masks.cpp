#include "oracle/limit_masks.h"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace oracle {
namespace {

using Index = std::uint32_t;
using Edge = std::pair<Index, Index>;
constexpr double pi = std::numbers::pi;

Edge edge_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

double weaker(double sharpness) { return sharpness >= infinite ? infinite : std::max(0.0, sharpness - 1); }

struct EdgeFaces {
    std::vector<Index> faces;
    double sharpness = 0;
    Index point = 0; ///< at the next level
};

std::map<Edge, EdgeFaces> edges_of(const Cage& cage) {
    std::map<Edge, EdgeFaces> edges;
    for (Index f = 0; f < cage.faces.size(); ++f) {
        const auto& v = cage.faces[f].vertex;
        for (std::size_t k = 0; k < v.size(); ++k) edges[edge_of(v[k], v[(k + 1) % v.size()])].faces.push_back(f);
    }
    for (auto& [edge, of] : edges) {
        const auto crease = cage.creases.find(edge);
        of.sharpness = of.faces.size() == 1 ? infinite : crease == cage.creases.end() ? 0 : crease->second;
    }
    return edges;
}

Vec3d centroid(const Cage& cage, Index face) {
    Vec3d sum(0);
    for (const Index v : cage.faces[face].vertex) sum += cage.points[v];
    return sum / double(cage.faces[face].vertex.size());
}

// The point of a smooth edge: from the centroids of its faces under Catmull-Clark, from the opposite vertices under Loop.
Vec3d smooth_edge_point(const Cage& cage, const Edge& edge, const EdgeFaces& of) {
    const Vec3d ends = cage.points[edge.first] + cage.points[edge.second];
    if (cage.scheme == bake::Scheme::catmark)
        return (ends + centroid(cage, of.faces[0]) + centroid(cage, of.faces[1])) / 4.0;
    Vec3d opposite(0);
    for (const Index f : of.faces) opposite += 3.0 * centroid(cage, f) - ends;
    return 3.0 / 8 * ends + 1.0 / 8 * opposite;
}

double loop_beta(int n) {
    const double c = 3.0 / 8 + std::cos(2 * pi / n) / 4;
    return (5.0 / 8 - c * c) / n;
}

struct Star {
    std::vector<std::pair<Index, double>> edges; ///< opposite end and sharpness of each edge
    std::vector<Index> faces;
};

Vec3d vertex_point(const Cage& cage, Index v, const Star& star, const std::vector<double>& sharpness, double corner) {
    const Vec3d& p = cage.points[v];
    std::vector<Index> sharp;
    for (std::size_t i = 0; i < star.edges.size(); ++i)
        if (sharpness[i] > 0) sharp.push_back(star.edges[i].first);
    if (corner > 0 || sharp.size() > 2) return p;
    if (sharp.size() == 2) return 0.75 * p + 0.125 * (cage.points[sharp[0]] + cage.points[sharp[1]]);
    const double n = double(star.edges.size());
    Vec3d ring(0), centres(0);
    for (const auto& [other, s] : star.edges) ring += cage.points[other];
    if (cage.scheme == bake::Scheme::loop) {
        const double beta = loop_beta(int(n));
        return (1 - n * beta) * p + beta * ring;
    }
    for (const Index f : star.faces) centres += centroid(cage, f);
    return (n - 2) / n * p + (ring + centres) / (n * n);
}

// The next position of a vertex. If sharp rules end at this level, they are blended with the remaining sharpness as weight.
Vec3d next_vertex(const Cage& cage, Index v, const Star& star) {
    std::vector<double> now, then;
    double left = 0;
    int ending = 0;
    for (const auto& [other, s] : star.edges) {
        now.push_back(s);
        then.push_back(weaker(s));
        if (s > 0 && weaker(s) == 0) left += s, ++ending;
    }
    const double corner = cage.corners[v];
    if (corner > 0 && weaker(corner) == 0) left += corner, ++ending;
    const Vec3d sharp = vertex_point(cage, v, star, now, corner);
    if (ending == 0) return sharp;
    const double weight = std::min(1.0, left / ending);
    return weight * sharp + (1 - weight) * vertex_point(cage, v, star, then, weaker(corner));
}

} // namespace

Cage cage_of(const bake::Mesh& mesh, bake::Scheme scheme) {
    Cage cage;
    cage.scheme = scheme;
    for (const bake::Vec3f& p : mesh.positions) cage.points.emplace_back(p);
    cage.corners.assign(cage.points.size(), 0);
    Index patch = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        Cage::Face face;
        face.vertex.assign(mesh.corner_position.begin() + mesh.face_begin[f],
                           mesh.corner_position.begin() + mesh.face_begin[f + 1]);
        face.patch = patch;
        const bool quad = face.vertex.size() == 4;
        if (scheme == bake::Scheme::loop) face.st = {{0, 0}, {1, 0}, {0, 1}};
        if (scheme == bake::Scheme::catmark && quad) face.st = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        patch += scheme == bake::Scheme::loop || quad ? 1 : Index(face.vertex.size());
        cage.faces.push_back(std::move(face));
    }
    for (const auto& crease : mesh.tags.creases) cage.creases[edge_of(crease.a, crease.b)] = double(crease.sharpness);
    for (const auto& corner : mesh.tags.corners) cage.corners[corner.position] = double(corner.sharpness);
    if (mesh.tags.boundary == bake::SubdivisionTags::Boundary::edge_and_corner) {
        std::vector<int> faces_at(cage.points.size(), 0);
        for (const auto& face : cage.faces)
            for (const Index v : face.vertex) ++faces_at[v];
        for (const auto& [edge, of] : edges_of(cage))
            if (of.faces.size() == 1)
                for (const Index v : {edge.first, edge.second})
                    if (faces_at[v] == 1) cage.corners[v] = infinite;
    }
    return cage;
}

Cage subdivide(const Cage& cage) {
    auto edges = edges_of(cage);
    std::vector<Star> stars(cage.points.size());
    for (const auto& [edge, of] : edges) {
        stars[edge.first].edges.emplace_back(edge.second, of.sharpness);
        stars[edge.second].edges.emplace_back(edge.first, of.sharpness);
    }
    for (Index f = 0; f < cage.faces.size(); ++f)
        for (const Index v : cage.faces[f].vertex) stars[v].faces.push_back(f);

    Cage fine;
    fine.scheme = cage.scheme;
    for (Index v = 0; v < cage.points.size(); ++v)
        fine.points.push_back(stars[v].faces.empty() ? cage.points[v] : next_vertex(cage, v, stars[v]));
    for (auto& [edge, of] : edges) {
        of.point = Index(fine.points.size());
        const Vec3d middle = 0.5 * (cage.points[edge.first] + cage.points[edge.second]);
        const double sharp = std::min(1.0, of.sharpness);
        fine.points.push_back(sharp == 1 ? middle : sharp * middle + (1 - sharp) * smooth_edge_point(cage, edge, of));
        if (weaker(of.sharpness) > 0)
            for (const Index v : {edge.first, edge.second}) fine.creases[edge_of(v, of.point)] = weaker(of.sharpness);
    }
    for (Index f = 0; f < cage.faces.size(); ++f) {
        const Cage::Face& face = cage.faces[f];
        const std::size_t n = face.vertex.size();
        std::vector<Index> middle;
        std::vector<Vec2d> middle_st;
        for (std::size_t k = 0; k < n; ++k) {
            middle.push_back(edges.at(edge_of(face.vertex[k], face.vertex[(k + 1) % n])).point);
            if (!face.st.empty()) middle_st.push_back(0.5 * (face.st[k] + face.st[(k + 1) % n]));
        }
        if (cage.scheme == bake::Scheme::loop) {
            for (std::size_t k = 0; k < 3; ++k)
                fine.faces.push_back({{face.vertex[k], middle[k], middle[(k + 2) % 3]},
                                      face.patch,
                                      {face.st[k], middle_st[k], middle_st[(k + 2) % 3]}});
            fine.faces.push_back({middle, face.patch, middle_st});
            continue;
        }
        const auto centre = Index(fine.points.size());
        fine.points.push_back(centroid(cage, f));
        for (std::size_t k = 0; k < n; ++k) {
            Cage::Face child{{face.vertex[k], middle[k], centre, middle[(k + n - 1) % n]}, face.patch, {}};
            if (face.st.empty()) {
                child.patch += Index(k);
                child.st = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            } else {
                child.st = {face.st[k], middle_st[k], 0.5 * (face.st[0] + face.st[2]), middle_st[(k + n - 1) % n]};
            }
            fine.faces.push_back(std::move(child));
        }
    }
    fine.corners.assign(fine.points.size(), 0);
    for (Index v = 0; v < cage.points.size(); ++v) fine.corners[v] = weaker(cage.corners[v]);
    return fine;
}

Cage neighbourhood(const Cage& cage, Index vertex) {
    std::vector<char> near(cage.points.size(), 0);
    for (const auto& face : cage.faces)
        if (std::count(face.vertex.begin(), face.vertex.end(), vertex))
            for (const Index v : face.vertex) near[v] = 1;
    Cage cut;
    cut.scheme = cage.scheme;
    std::map<Index, Index> number;
    const auto renumber = [&](Index v) {
        const auto [found, added] = number.try_emplace(v, Index(number.size()));
        if (added) cut.points.push_back(cage.points[v]), cut.corners.push_back(cage.corners[v]);
        return found->second;
    };
    renumber(vertex);
    for (const auto& face : cage.faces) {
        if (std::none_of(face.vertex.begin(), face.vertex.end(), [&](Index v) { return near[v]; })) continue;
        Cage::Face copy = face;
        for (Index& v : copy.vertex) v = renumber(v);
        cut.faces.push_back(std::move(copy));
    }
    for (const auto& [edge, sharpness] : cage.creases)
        if (number.count(edge.first) && number.count(edge.second))
            cut.creases[edge_of(number[edge.first], number[edge.second])] = sharpness;
    return cut;
}

LimitMasks::LimitMasks(const Cage& cage) : cage_(cage), sharp_edges_(cage.points.size(), 0) {
    for (Index f = 0; f < cage.faces.size(); ++f) {
        const auto& v = cage.faces[f].vertex;
        for (Index k = 0; k < v.size(); ++k) leaving_[{v[k], v[(k + 1) % v.size()]}] = {f, k};
    }
    for (const auto& [edge, of] : edges_of(cage)) {
        if (of.sharpness > 0 && of.sharpness < infinite) throw std::logic_error("a crease is still semi-sharp");
        if (of.sharpness == 0) continue;
        ++sharp_edges_[edge.first];
        ++sharp_edges_[edge.second];
    }
}

LimitMasks::Sector LimitMasks::sector(FaceCorner at, bool stop_at_creases) const {
    const auto vertex = [&](FaceCorner place, std::size_t ahead) {
        const auto& v = cage_.faces[place.face].vertex;
        return v[(place.corner + ahead) % v.size()];
    };
    const Index v = vertex(at, 0);
    const auto last = [&](FaceCorner place) { return cage_.faces[place.face].vertex.size() - 1; };
    const auto stops = [&](Index other) {
        return stop_at_creases && cage_.creases.count(edge_of(v, other)) && cage_.creases.at(edge_of(v, other)) > 0;
    };
    // Rotates clockwise to the first face of the sector.
    const FaceCorner from = at;
    bool closed = false;
    for (;;) {
        const Index other = vertex(at, 1);
        const auto across = leaving_.find({other, v});
        if (across == leaving_.end() || stops(other)) break;
        const FaceCorner next = across->second;
        at = {next.face, Index((next.corner + 1) % cage_.faces[next.face].vertex.size())};
        if (at.face == from.face && at.corner == from.corner) {
            closed = true;
            break;
        }
    }
    Sector sector;
    sector.closed = closed;
    const FaceCorner begin = at;
    for (;;) {
        sector.edges.push_back(cage_.points[vertex(at, 1)]);
        if (cage_.scheme == bake::Scheme::catmark) sector.diagonals.push_back(cage_.points[vertex(at, 2)]);
        const Index other = vertex(at, last(at));
        const auto across = leaving_.find({v, other});
        if (across == leaving_.end() || (!closed && stops(other))) {
            sector.edges.push_back(cage_.points[other]);
            return sector;
        }
        at = across->second;
        if (at.face == begin.face && at.corner == begin.corner) return sector;
    }
}

namespace {

// The tangent across a crease or border: the left eigenvector of the sector's subdivision matrix. Its components are sines
// at the inner points; a at the vertex and b at the two ends follow from the columns of the matrix. Published tables
// (Hoppe, Biermann) are for modified rules at irregular vertices; they agree with this where the rules do.
Vec3d across_crease(const Vec3d& v, const std::vector<Vec3d>& e, const std::vector<Vec3d>& f, bool loop) {
    const int k = int(e.size()) - 1; // faces
    const double theta = pi / k, c = std::cos(theta);
    const double lambda = loop ? 3.0 / 8 + c / 4 : (c + 5 + std::sqrt((c + 9) * (c + 1))) / 16;
    const auto sine = [theta](int i) { return std::sin(i * theta); };
    const auto diagonal = [&](int i) { return loop ? 0 : (sine(i) + sine(i + 1)) / (16 * lambda - 4); };
    Vec3d across(0);
    double sines = 0, diagonals = 0;
    for (int i = 1; i < k; ++i) {
        across += sine(i) * e[std::size_t(i)];
        sines += sine(i);
    }
    for (int i = 0; i < k; ++i) {
        if (!loop) across += diagonal(i) * f[std::size_t(i)];
        diagonals += diagonal(i);
    }
    const double at_end = loop ? sine(1) / 8 : sine(1) / 16 + diagonal(0) / 4,
                 at_vertex = 3.0 / 8 * sines + diagonals / 4;
    const double det = (lambda - 1) * (lambda - 0.25);
    const double a = ((lambda - 0.5) * at_vertex + at_end) / det, b = ((lambda - 0.75) * at_end + at_vertex / 8) / det;
    return across + a * v + b * (e.front() + e.back());
}

} // namespace

Limit LimitMasks::dart(Index vertex) const {
    Cage cut = neighbourhood(cage_, vertex);
    const auto smooth = [&cut] {
        Cage copy = cut;
        copy.creases.clear();
        for (Index f = 0; f < copy.faces.size(); ++f)
            for (Index k = 0; k < copy.faces[f].vertex.size(); ++k)
                if (copy.faces[f].vertex[k] == 0) return LimitMasks(copy).at(f, k);
        throw std::logic_error("the dart has no face");
    };
    Limit limit;
    for (int level = 1; level <= 20; ++level) {
        cut = neighbourhood(subdivide(cut), 0);
        if (level == 14) limit.normal = smooth().normal; // at later levels rounding dominates
    }
    limit.p = smooth().p;
    return limit;
}

Limit LimitMasks::at(Index face, Index corner) const {
    const Index vertex = cage_.faces[face].vertex[corner];
    const Vec3d& v = cage_.points[vertex];
    const bool loop = cage_.scheme == bake::Scheme::loop;
    if (cage_.corners[vertex] > 0 && cage_.corners[vertex] < infinite)
        throw std::logic_error("a corner is still semi-sharp");
    const bool is_corner = cage_.corners[vertex] > 0 || sharp_edges_[vertex] > 2;
    const bool is_crease = !is_corner && sharp_edges_[vertex] == 2;
    if (!is_corner && sharp_edges_[vertex] == 1) return dart(vertex);
    const Sector ring = sector({face, corner}, is_corner || is_crease);
    const auto& e = ring.edges;
    const auto& f = ring.diagonals;

    if (is_corner) {
        if (ring.closed || e.size() > 2) return {v, {}};
        return {v, glm::cross(e[0] - v, e[1] - v)};
    }
    if (is_crease) {
        const int k = int(e.size()) - 1; // faces of the sector
        const Vec3d p = (4.0 * v + e.front() + e.back()) / 6.0;
        if (k == 1) return {p, {}};
        return {p, glm::cross(e.front() - e.back(), across_crease(v, e, f, loop))};
    }
    const int n = int(e.size());
    Vec3d sum_e(0), sum_f(0), t1(0), t2(0);
    const double theta = 2 * pi / n;
    const double a = 1 + std::cos(theta) + std::cos(pi / n) * std::sqrt(2 * (9 + std::cos(theta)));
    for (int i = 0; i < n; ++i) {
        const Vec3d& edge = e[std::size_t(i)];
        sum_e += edge;
        t1 += (loop ? 1 : a) * std::cos(i * theta) * edge;
        t2 += (loop ? 1 : a) * std::sin(i * theta) * edge;
        if (loop) continue;
        sum_f += f[std::size_t(i)];
        t1 += (std::cos(i * theta) + std::cos((i + 1) * theta)) * f[std::size_t(i)];
        t2 += (std::sin(i * theta) + std::sin((i + 1) * theta)) * f[std::size_t(i)];
    }
    if (loop) {
        const double w = 3 / (8 * loop_beta(n));
        return {(w * v + sum_e) / (w + n), glm::cross(t1, t2)};
    }
    return {(double(n) * n * v + 4.0 * sum_e + sum_f) / (double(n) * (n + 5)), glm::cross(t1, t2)};
}

} // namespace oracle
