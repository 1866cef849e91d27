// The reference job of high-poly to low-poly: a torus R = 1, r = 0.4 of 4096 triangles receives the relief
// A sin(2 pi k u) sin(2 pi m v) of a fine mesh as a tangent-space normal map.
//
// The truths of a texel are computed on the formula of the relief, in double, and share no code with the bake but the
// tangents of MikkTSpace, which are a convention and not a result:
//   one ray       the line through the centre's point of LOW along LOW's interpolated normal meets the relief in a point,
//                 whose exact normal is the truth
//   box-filtered  the mean of the tangent-space normals of such rays over the area of the texel
#pragma once
#include "bake/mesh/triangulate.h"
#include "bake/surface/chart/tangent_space.h"
#include "relief/map/torus_relief.h"
#include <glm/matrix.hpp>
#include <stdexcept>

namespace oracle {

/// Where LOW has the texture coordinates (u, v), and its frame there. T and N are interpolated and not normalised;
/// B = sign (N x T).
struct LowPoint {
    Vec3d p, T, B, N;

    /// The vector t.x T + t.y B + t.z N: what a shader makes of a texel.
    Vec3d to_object(const Vec3d& t) const { return t.x * T + t.y * B + t.z * N; }
    /// The t with to_object(t) = n, normalised.
    Vec3d to_tangent(const Vec3d& n) const { return glm::normalize(glm::inverse(glm::dmat3(T, B, N)) * n); }
};

/// LOW: `columns` x `rows` quads, split along the diagonal of corners 0-2, with the exact normals of the torus and its
/// MikkTSpace tangents.
class LowTorus {
public:
    explicit LowTorus(int columns = 64, int rows = 32)
        : columns_(columns), rows_(rows), mesh_(torus_mesh(columns, rows)) {
        std::vector<bake::Vec3f> normals;
        for (const std::uint32_t n : mesh_.corner_normal) normals.push_back(mesh_.normals[n]);
        tangents_ = bake::corner_tangents(mesh_, bake::triangulate(mesh_), normals);
    }

    const bake::Mesh& mesh() const { return mesh_; }

    /// u and v in [0, 1]. The chart is a grid, so that the triangle follows from the coordinates.
    LowPoint at(double u, double v) const {
        const double x = u * columns_, y = v * rows_;
        const int i = std::min(int(x), columns_ - 1), j = std::min(int(y), rows_ - 1);
        const double s = x - i, t = y - j;
        const int upper = t > s;
        const double weights[2][3] = {{1 - s, s - t, t}, {1 - t, s, t - s}};
        const std::uint32_t first = mesh_.face_begin[std::size_t(2 * (i * rows_ + j) + upper)];
        LowPoint point{};
        for (std::uint32_t k = 0; k < 3; ++k) {
            const double weight = weights[upper][k];
            point.p += weight * Vec3d(mesh_.positions[mesh_.corner_position[first + k]]);
            point.N += weight * Vec3d(mesh_.normals[mesh_.corner_normal[first + k]]);
            point.T += weight * Vec3d(bake::Vec3f(tangents_[first + k]));
        }
        point.B = double(tangents_[first].w) * glm::cross(point.N, point.T);
        return point;
    }

private:
    int columns_, rows_;
    bake::Mesh mesh_;
    std::vector<bake::Vec4f> tangents_;
};

/// HIGH: 2 `columns` x `rows` triangles with their corners on the relief and its exact normals there.
inline bake::Mesh relief_mesh(const TorusRelief& r, int columns, int rows) {
    bake::Mesh mesh = torus_mesh(columns, rows);
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const ReliefPoint s = relief_point(r, double(i) / columns, double(j) / rows);
            mesh.positions[std::size_t(i * rows + j)] = bake::Vec3f(s.p);
            mesh.normals[std::size_t(i * rows + j)] = bake::Vec3f(s.normal());
        }
    return mesh;
}

/// The relief at (u, v), met by a line at the distance t from its origin.
struct ReliefHit {
    double u, v, t;
    ReliefPoint point;
};

/// Where the line p + t d, d of length 1, meets the relief, to 1e-12 in space: Newton's method in (u, v, t) from `start`.
/// A line along a normal of LOW meets the relief once near LOW, as long as its angle to the normal of the torus is far
/// smaller than the relief's slope is from vertical. Throws std::runtime_error if the iteration does not end.
inline ReliefHit meet_relief(const TorusRelief& r, const Vec3d& p, const Vec3d& d, const Vec3d& start) {
    Vec3d x = start;
    for (int iteration = 0; iteration < 40; ++iteration) {
        const ReliefPoint s = relief_point(r, x.x, x.y);
        const Vec3d miss = p + x.z * d - s.p;
        if (glm::dot(miss, miss) < 1e-24) return {x.x, x.y, x.z, s};
        // Cramer's rule for p_u du + p_v dv - d dt = miss.
        const Vec3d vd = glm::cross(s.p_v, d);
        const double det = glm::dot(s.p_u, vd);
        x += Vec3d(glm::dot(miss, vd), -glm::dot(miss, glm::cross(s.p_u, d)),
                   -glm::dot(miss, glm::cross(s.p_u, s.p_v))) /
             det;
    }
    throw std::runtime_error("meet_relief: no convergence");
}

/// Truth of one ray: the exact normal, in the tangent space of LOW, where the line at (u, v) meets the relief. `offset` is
/// (u, v, t) of the hit minus (u, v, 0): where the search begins, from a neighbour, and what it found.
inline Vec3d one_ray_normal(const LowTorus& low, const TorusRelief& r, double u, double v, Vec3d& offset) {
    const LowPoint at = low.at(u, v);
    const ReliefHit hit = meet_relief(r, at.p, glm::normalize(at.N), Vec3d(u, v, 0) + offset);
    offset = Vec3d(hit.u - u, hit.v - v, hit.t);
    return at.to_tangent(hit.point.normal());
}
inline Vec3d one_ray_normal(const LowTorus& low, const TorusRelief& r, double u, double v) {
    Vec3d offset(0);
    return one_ray_normal(low, r, u, v, offset);
}

/// Nodes and weights of Gauss and Legendre on [-1/2, 1/2]; the weights sum to 1.
struct GaussRule {
    std::vector<double> nodes, weights;

    explicit GaussRule(int n) {
        for (int i = 0; i < n; ++i) {
            double x = cos(pi * (i + 0.75) / (n + 0.5)), slope = 0;
            for (int iteration = 0; iteration < 20; ++iteration) {
                double before = 1, value = x; // P_0 and P_1, then P_(n-1) and P_n
                for (int k = 2; k <= n; ++k)
                    before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
                slope = n * (x * value - before) / (x * x - 1);
                x -= value / slope;
            }
            nodes.push_back(x / 2);
            weights.push_back(1 / ((1 - x * x) * slope * slope));
        }
    }
};

/// Truth of many rays: the mean of one_ray_normal() over a texel with its centre at (u, v), `side_u` x `side_v` large,
/// normalised.
inline Vec3d box_normal(const LowTorus& low, const TorusRelief& r, const GaussRule& rule, double u, double v,
                        double side_u, double side_v) {
    Vec3d sum(0), offset(0);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        for (std::size_t j = 0; j < rule.nodes.size(); ++j)
            sum += rule.weights[i] * rule.weights[j] *
                   one_ray_normal(low, r, u + rule.nodes[i] * side_u, v + rule.nodes[j] * side_v, offset);
    return glm::normalize(sum);
}

} // namespace oracle
