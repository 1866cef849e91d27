// Rays from inside closed meshes: none escapes through a face or an edge, hardly any at a vertex.
#include "bake/ray/bvh.h"
#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <vector>

using namespace bake;

namespace {

struct Closed {
    std::vector<Vec3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A closed ball of `n` x `n` quads to a side of a cube, with dents: star-shaped about its centre.
Closed dented_ball(int n, float radius, const Vec3f& centre) {
    Closed ball;
    std::vector<std::uint32_t> known(std::size_t(n + 1) * (n + 1) * (n + 1), ~0u);
    const auto vertex = [&](int x, int y, int z) {
        std::uint32_t& index = known[(std::size_t(x) * (n + 1) + y) * (n + 1) + z];
        if (index != ~0u) return index;
        const Vec3d d = glm::normalize(Vec3d(2 * x - n, 2 * y - n, 2 * z - n));
        const double r = radius * (1 + 0.15 * std::sin(7 * d.x + 1) * std::cos(5 * d.y) * std::sin(6 * d.z + 2));
        ball.positions.push_back(Vec3f(Vec3d(centre) + r * d));
        return index = std::uint32_t(ball.positions.size() - 1);
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {0, n})
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto corner = [&](int a, int b) {
                        int at[3];
                        at[axis] = side, at[(axis + 1) % 3] = a, at[(axis + 2) % 3] = b;
                        return vertex(at[0], at[1], at[2]);
                    };
                    const std::uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                                        d = corner(i, j + 1);
                    ball.triangles.push_back({a, b, c});
                    ball.triangles.push_back({a, c, d});
                }
    return ball;
}

struct Escapes {
    int vertices = 0, edges = 0, faces = 0, vertex_rays = 0, edge_rays = 0, face_rays = 0;
};

/// Aims rays from random points inside at every vertex, at points on every edge and in every face.
Escapes count_escapes(const Closed& mesh, float radius, const Vec3f& centre, BvhTree tree = BvhTree::fast) {
    const BvhMesh input{mesh.positions, mesh.triangles};
    const Bvh bvh({input}, tree);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0, 1);
    const auto escapes = [&](const Vec3f& at) {
        const Vec3f inside =
            centre + 0.4f * radius * (Vec3f(uniform(random), uniform(random), uniform(random)) - Vec3f(0.5f));
        const Ray ray{inside, glm::normalize(at - inside)}; // of unit length, as the tracer's are
        return !bvh.intersect(ray) || !bvh.occluded(ray);
    };
    Escapes count;
    for (const Vec3f& p : mesh.positions) ++count.vertex_rays, count.vertices += escapes(p);
    for (const auto& t : mesh.triangles) {
        const Vec3f a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        const float along = uniform(random), x = std::sqrt(uniform(random)), y = uniform(random);
        ++count.edge_rays, count.edges += escapes(a + along * (b - a)) || escapes(0.5f * b + 0.5f * c);
        ++count.face_rays, count.faces += escapes((1 - x) * a + x * (1 - y) * b + x * y * c);
    }
    return count;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("closed mesh: from a quick tree rays do not escape either") {
        const Vec3f centre(1);
        const Escapes count = count_escapes(dented_ball(48, 1, centre), 1, centre, BvhTree::quick);
        CHECK(count.vertices * 100 < count.vertex_rays);
        CHECK(count.edges == 0);
        CHECK(count.faces == 0);
    }

    TEST_CASE("closed mesh: rays aimed at faces and edges from inside never escape, at vertices less than 1 in 100") {
        for (const float radius : {1e-3f, 1.0f, 1000.0f})
            for (const float far : {0.0f, 1.0f, 10.0f}) {
                const Vec3f centre(far * radius);
                const Escapes count = count_escapes(dented_ball(48, radius, centre), radius, centre);
                CAPTURE(radius);
                CAPTURE(far);
                MESSAGE(count.vertices << " of " << count.vertex_rays << " at vertices, " << count.edges << " of "
                                       << count.edge_rays << " at edges, " << count.faces << " of " << count.face_rays
                                       << " at faces");
                CHECK(count.vertex_rays > 13000);
                CHECK(count.edge_rays > 27000);
                CHECK(count.vertices * 100 < count.vertex_rays);
                CHECK(count.edges == 0);
                CHECK(count.faces == 0);
            }
    }

} // TEST_SUITE
