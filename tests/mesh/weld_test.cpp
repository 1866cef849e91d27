#include "bake/base/parallel.h"
#include "bake/mesh/weld.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;

namespace {

/// Random corners of few values, zeros of both signs among them.
struct Corners {
    std::vector<Vec3f> positions, normals;
    std::vector<Vec2f> uvs;

    explicit Corners(int count) {
        std::mt19937 random(1);
        const auto value = [&] { return std::array{-1.0f, -0.0f, 0.0f, 1.0f}[random() % 4]; };
        for (int i = 0; i < count; ++i) {
            positions.emplace_back(value(), value(), value());
            normals.emplace_back(0, 0, value());
            uvs.emplace_back(value(), 0);
        }
    }
};

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE(
        "weld_corners: one vertex for equal position, normal and uv, numbered by first use, as found pair by pair") {
        const Corners c(1500);
        const Weld weld = weld_corners(c.positions, c.normals, c.uvs);
        REQUIRE(weld.vertex.size() == 1500);
        std::vector<std::size_t> first; // per vertex
        for (std::size_t i = 0; i < 1500; ++i) {
            std::size_t k = 0;
            while (k < first.size() && !(c.positions[first[k]] == c.positions[i] &&
                                         c.normals[first[k]] == c.normals[i] && c.uvs[first[k]] == c.uvs[i]))
                ++k;
            if (k == first.size()) first.push_back(i);
            REQUIRE(weld.vertex[i] == k);
        }
        CHECK(weld.vertices == first.size());
    }

    TEST_CASE("first_equal and weld_positions: each corner names the first position equal to its own") {
        const Corners c(300);
        Mesh mesh;
        mesh.positions = c.positions;
        for (std::uint32_t i = 0; i < 300; ++i) mesh.corner_position.push_back(299 - i);
        for (std::uint32_t f = 1; f <= 100; ++f) mesh.face_begin.push_back(3 * f);
        const std::vector<std::uint32_t> first = first_equal(mesh.positions);
        for (std::size_t i = 0; i < 300; ++i) {
            std::size_t expected = 0;
            while (c.positions[expected] != c.positions[i]) ++expected;
            CHECK(first[i] == expected);
        }
        weld_positions(mesh);
        CHECK(mesh.positions == c.positions);
        for (std::uint32_t i = 0; i < 300; ++i) CHECK(mesh.corner_position[i] == first[299 - i]);
    }
}

TEST_SUITE("stability") {
    TEST_CASE("weld_corners: the same for any number of threads, and nothing for nothing") {
        CHECK(weld_corners({}, {}, {}).vertices == 0);
        CHECK(first_equal({}).empty());
        const Corners c(200000);
        const auto with = [&](int threads) {
            const ThreadLimit limit(threads);
            return weld_corners(c.positions, c.normals, c.uvs).vertex;
        };
        const auto one = with(1);
        CHECK(with(2) == one);
        CHECK(with(7) == one);
    }
}
