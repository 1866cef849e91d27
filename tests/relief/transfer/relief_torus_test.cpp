// The truths of the reference job are tested before anything is measured with them.
#include "relief/transfer/relief_torus.h"
#include <doctest/doctest.h>
#include <random>

using namespace oracle;

namespace {

constexpr TorusRelief relief_asset{}, aliasing_asset{.A = 0.002, .k = 96, .m = 48};

/// How far above the relief p is along the normal of the torus: from the torus's own coordinates of p alone.
double above_relief(const TorusRelief& r, const Vec3d& p) {
    const double ring = std::hypot(p.x, p.y) - 1;
    const double u = std::atan2(p.y, p.x) / (2 * pi), v = std::atan2(p.z, ring) / (2 * pi);
    return std::hypot(ring, p.z) - 0.4 - relief(r, u, v).b;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("relief_point: its derivatives are those of its position") {
        const double h = 1e-6;
        for (const TorusRelief& r : {relief_asset, aliasing_asset})
            for (const auto& [u, v] : {std::pair(0.123, 0.456), {0.7, 0.05}, {0.999, 0.5}}) {
                const ReliefPoint s = relief_point(r, u, v);
                const Vec3d p_u = (relief_point(r, u + h, v).p - relief_point(r, u - h, v).p) / (2 * h);
                const Vec3d p_v = (relief_point(r, u, v + h).p - relief_point(r, u, v - h).p) / (2 * h);
                CHECK(glm::length(p_u - s.p_u) < 1e-6 * glm::length(s.p_u));
                CHECK(glm::length(p_v - s.p_v) < 1e-6 * glm::length(s.p_v));
                CHECK(std::abs(above_relief(r, s.p)) < 1e-12);
                CHECK(above_relief(r, s.p + 1e-4 * s.normal()) > 0);
            }
    }

    TEST_CASE("LowTorus::at: the point of the triangle that has the texture coordinates, in a right-handed frame") {
        const LowTorus low;
        const bake::Mesh& mesh = low.mesh();
        CHECK(mesh.faces() == 4096);
        std::mt19937 random(1);
        std::uniform_real_distribution<double> in(0, 1);
        for (int i = 0; i < 50; ++i) {
            const Vec2d at(in(random), in(random));
            int found = 0;
            for (std::size_t f = 0; f < mesh.faces(); ++f) {
                const std::uint32_t c = mesh.face_begin[f];
                const auto uv = [&](std::uint32_t k) { return Vec2d(mesh.uvs[mesh.corner_uv[c + k]]); };
                const glm::dmat2 sides(uv(1) - uv(0), uv(2) - uv(0));
                const Vec2d b = glm::inverse(sides) * (at - uv(0));
                if (b.x < 0 || b.y < 0 || b.x + b.y > 1) continue;
                ++found;
                const auto p = [&](std::uint32_t k) { return Vec3d(mesh.positions[mesh.corner_position[c + k]]); };
                const auto n = [&](std::uint32_t k) { return Vec3d(mesh.normals[mesh.corner_normal[c + k]]); };
                const LowPoint point = low.at(at.x, at.y);
                CHECK(glm::distance(point.p, (1 - b.x - b.y) * p(0) + b.x * p(1) + b.y * p(2)) < 1e-12);
                CHECK(glm::distance(point.N, (1 - b.x - b.y) * n(0) + b.x * n(1) + b.y * n(2)) < 1e-12);
            }
            CHECK(found == 1);
            const LowPoint point = low.at(at.x, at.y);
            const Jet<double> s = unit_torus(at.x, at.y);
            CHECK(angle_deg(point.T, s.p_u) < 3); // at the seams tangents are those of one side
            CHECK(angle_deg(point.B, s.p_v) < 3);
            CHECK(angle_deg(point.N, s.n) < 0.5);
            const Vec3d n = glm::normalize(Vec3d(0.3, -0.5, 0.7));
            CHECK(angle_deg(point.to_object(point.to_tangent(n)), n) < 1e-10);
        }
    }

    TEST_CASE("meet_relief: the only point near LOW in which a line along its normal meets the relief") {
        const LowTorus low;
        std::mt19937 random(2);
        std::uniform_real_distribution<double> in(0, 1);
        for (const TorusRelief& r : {relief_asset, aliasing_asset})
            for (int i = 0; i < 200; ++i) {
                const double u = in(random), v = in(random);
                const LowPoint at = low.at(u, v);
                const Vec3d d = glm::normalize(at.N);
                const ReliefHit hit = meet_relief(r, at.p, d, {u, v, 0});
                CHECK(glm::distance(at.p + hit.t * d, hit.point.p) < 1e-12);
                // By bisection, and by counting changes of sign.
                double inside = -0.03, outside = 0.03;
                int changes = 0;
                for (int k = 0; k < 600; ++k) {
                    const double t = -0.03 + 1e-4 * k;
                    changes += (above_relief(r, at.p + t * d) < 0) != (above_relief(r, at.p + (t + 1e-4) * d) < 0);
                }
                CHECK(changes == 1);
                for (int k = 0; k < 50; ++k) {
                    const double t = (inside + outside) / 2;
                    (above_relief(r, at.p + t * d) < 0 ? inside : outside) = t;
                }
                CHECK(std::abs(hit.t - inside) < 1e-11);
            }
        CHECK_THROWS(meet_relief(relief_asset, {5, 5, 5}, {0, 0, 1}, {0.1, 0.1, 0}));
    }

    TEST_CASE("relief_mesh: corners on the relief with its normals, triangles turned outward") {
        const bake::Mesh mesh = relief_mesh(relief_asset, 240, 120);
        CHECK(mesh.faces() == 57600);
        double worst = 0;
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            Vec3d p[3], n(0);
            for (std::uint32_t k = 0; k < 3; ++k) {
                p[k] = Vec3d(mesh.positions[mesh.corner_position[mesh.face_begin[f] + k]]);
                n += Vec3d(mesh.normals[mesh.corner_normal[mesh.face_begin[f] + k]]);
                worst = std::max(worst, std::abs(above_relief(relief_asset, p[k])));
            }
            CHECK_MESSAGE(angle_deg(glm::cross(p[1] - p[0], p[2] - p[0]), n) < 12, f);
        }
        CHECK(worst < 2e-7); // floats
    }

    TEST_CASE("GaussRule: exact up to degree 2 n - 1") {
        for (const int n : {1, 2, 4, 8, 16}) {
            const GaussRule rule(n);
            for (int degree = 0; degree < 2 * n; ++degree) {
                double sum = 0;
                for (std::size_t i = 0; i < rule.nodes.size(); ++i)
                    sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
                CHECK(std::abs(sum - (degree % 2 ? 0 : std::pow(0.5, degree) / (degree + 1))) < 1e-14);
            }
        }
    }

    TEST_CASE("box_normal: converged with the nodes that the judge takes, to the mean of many rays") {
        const LowTorus low;
        std::mt19937 random(3);
        const auto worst = [&](const TorusRelief& r, int size, int nodes, int texels, const auto& truth) {
            double angle = 0;
            for (int i = 0; i < texels; ++i) {
                const double u = (int(random() % unsigned(size)) + 0.5) / size;
                // Every second texel is on a diagonal, where the frame of LOW has a kink.
                const double v = i % 2 ? (int(random() % unsigned(size)) + 0.5) / size
                                       : (std::floor(std::fmod(2 * u, 1.0) * size) + 0.5) / size;
                const Vec3d box = box_normal(low, r, GaussRule(nodes), u, v, 1.0 / size, 1.0 / size);
                angle = std::max(angle, angle_deg(box, truth(r, u, v, size)));
            }
            return angle;
        };
        const auto finer = [&](const TorusRelief& r, double u, double v, int size) {
            return box_normal(low, r, GaussRule(16), u, v, 1.0 / size, 1.0 / size);
        };
        const auto many = [&](const TorusRelief& r, double u, double v, int size) {
            Vec3d sum(0);
            for (int i = 0; i < 40; ++i)
                for (int j = 0; j < 40; ++j)
                    sum += one_ray_normal(low, r, u + ((i + 0.5) / 40 - 0.5) / size, v + ((j + 0.5) / 40 - 0.5) / size);
            return glm::normalize(sum);
        };
        CHECK(worst(relief_asset, 1024, 4, 400, finer) < 0.001);
        CHECK(worst(aliasing_asset, 256, 8, 400, finer) < 0.001);
        CHECK(worst(relief_asset, 1024, 4, 10, many) < 0.001);
        CHECK(worst(aliasing_asset, 256, 8, 10, many) < 0.004); // the sum of many rays has this error itself
    }
}
