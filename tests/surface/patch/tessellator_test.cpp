// The tessellator: each vertex is written once, faces close, and nothing depends on the number of threads.
#include "bake/base/parallel.h"
#include "bake/mesh/check/mesh_check.h"
#include "bake/surface/patch/tessellator.h"
#include "oracle/surfaces.h"
#include "surface/patch/complexes.h"
#include "surface/subdivision/cages.h"
#include <atomic>
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// Rates that differ from edge to edge.
CellRates mixed_rates(const PatchCells& cells) {
    CellRates rates;
    for (std::uint32_t e = 0; e < cells.complex().edges; ++e) rates.edge.push_back(std::uint16_t(1 + e * 7 % 5));
    for (std::uint32_t c = 0; c < cells.count(); ++c) {
        rates.across.push_back(std::uint16_t(1 + c % 4));
        rates.up.push_back(std::uint16_t(1 + c % 3));
        if (cells.complex().patches[c].sides() == 3) rates.up.back() = rates.across.back();
    }
    return rates;
}

/// The base itself; counts how often each position and normal is written.
struct Counts {
    std::vector<int> positions, normals;
};
Mesh tessellated(const PatchLayout& layout, Counts& counts) {
    counts.positions.assign(layout.points, 0), counts.normals.assign(layout.normals, 0);
    return tessellate(layout, {.at_patch =
                                   [&](const PatchVertices& v, Mesh& mesh, std::size_t) {
                                       for (std::size_t k = 0; k < v.index.size(); ++k) {
                                           mesh.positions[v.index[k]] = Vec3f(v.points[k].jet.p);
                                           mesh.normals[v.index[k]] = Vec3f(v.points[k].jet.n);
                                           ++counts.positions[v.index[k]], ++counts.normals[v.index[k]];
                                       }
                                   },
                               .at_junction =
                                   [&](const JunctionVertices& v, Mesh& mesh, std::size_t) {
                                       for (std::uint32_t j = 0; j < v.count; ++j) {
                                           mesh.positions[v.first_index + j] = Vec3f(v.points[j].jet.p);
                                           ++counts.positions[v.first_index + j];
                                           for (std::size_t k = 0; k < v.sides.size(); ++k)
                                               mesh.normals[v.normal_index(v.sides[k].normal_group, j)] =
                                                   Vec3f(v.points[k * v.count + j].jet.n);
                                           for (std::uint32_t g = 0; g < v.junction.normal_groups; ++g)
                                               ++counts.normals[v.normal_index(g, j)];
                                       }
                                   }});
}

bool all_one(const std::vector<int>& counts) {
    return std::all_of(counts.begin(), counts.end(), [](int n) { return n == 1; });
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("tessellate: mixed rates give closed meshes, and each position and normal is written once") {
        const BaseSurface box(bake_tests::box(), SubdivisionOptions{});
        const BaseSurface torus(oracle::torus_mesh(8, 6, true), SubdivisionOptions{});
        const BaseSurface triangles(oracle::torus_mesh(6, 5), SubdivisionOptions{.scheme = Scheme::loop});
        const BaseSurface sphere(ParametricSurface("sphere"), 6, 3), cone(ParametricSurface("cone"), 6, 3);
        const std::pair<const char*, const BaseSurface*> bases[] = {
            {"box", &box}, {"torus", &torus}, {"triangles", &triangles}, {"sphere", &sphere}, {"cone", &cone}};
        for (const auto& [name, base] : bases)
            for (const std::uint32_t split : {1u, 2u}) {
                INFO(std::string(name));
                CAPTURE(split);
                const PatchCells cells(*base, split);
                const CellRates rates = mixed_rates(cells);
                const PatchLayout layout = make_layout(cells, rates, !base->mesh().corner_uv.empty());
                Counts counts;
                const Mesh mesh = tessellated(layout, counts);
                CHECK(all_one(counts.positions));
                CHECK(all_one(counts.normals));
                CHECK(mesh.faces() == layout.faces);
                CHECK(mesh.face_begin.back() == layout.corners);
                const Connectivity topology = check_mesh(mesh, triangulate(mesh)).topology;
                CHECK((topology.boundary_edges == 0) == (base != &cone)); // a cone has no lid
                CHECK(topology.nonmanifold_edges == 0);
                CHECK(topology.flipped_faces == 0);
            }
    }

    TEST_CASE("tessellate: at an edge of four faces each keeps its normal and its uvs, along all of the edge") {
        // Pages of a book: page k stands at a quarter turn from the one before, and has the uvs of its own unit square.
        Mesh book = test::polygons({{0, 0, 0},
                                    {0, 0, 1},
                                    {1, 0, 0},
                                    {1, 0, 1},
                                    {0, 1, 0},
                                    {0, 1, 1},
                                    {-1, 0, 0},
                                    {-1, 0, 1},
                                    {0, -1, 0},
                                    {0, -1, 1}},
                                   {{0, 2, 3, 1}, {0, 4, 5, 1}, {0, 6, 7, 1}, {0, 8, 9, 1}});
        const Vec3f normal[] = {{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
        for (std::uint32_t page = 0; page < 4; ++page)
            for (std::uint32_t k = 0; k < 4; ++k) {
                book.normals.push_back(normal[page]);
                book.uvs.push_back(Vec2f(float(2 * page) + float(k == 1 || k == 2), float(k >= 2)));
                book.corner_normal.push_back(4 * page + k), book.corner_uv.push_back(4 * page + k);
            }
        const BaseSurface base(book);
        const PatchCells cells(base, 1);
        const CellRates rates{.uniform = 4};
        Counts counts;
        const Mesh mesh = tessellated(make_layout(cells, rates, true), counts);
        CHECK(all_one(counts.positions));
        CHECK(all_one(counts.normals));
        REQUIRE(mesh.faces() == 4 * 16);
        for (std::uint32_t f = 0; f < mesh.faces(); ++f)
            for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
                const std::uint32_t page = f / 16;
                const Vec3f& p = mesh.positions[mesh.corner_position[c]];
                CHECK(mesh.normals[mesh.corner_normal[c]] == normal[page]);
                const Vec2f uv(float(2 * page) + std::abs(p.x) + std::abs(p.y), p.z);
                CHECK(glm::length(mesh.uvs[mesh.corner_uv[c]] - uv) < 1e-6f);
            }
    }

    TEST_CASE("tessellate: any number of threads gives the same bytes, and jobs are numbered below their count") {
        const BaseSurface base(oracle::torus_mesh(40, 30, true), SubdivisionOptions{});
        const PatchCells cells(base, 2);
        const CellRates rates = mixed_rates(cells);
        const auto run = [&](int threads) {
            const ThreadLimit limit(threads);
            std::size_t jobs = 0;
            std::atomic<bool> in_range{true};
            Mesh mesh = tessellate(make_layout(cells, rates, true),
                                   {.begin = [&](std::size_t count) { jobs = count; },
                                    .at_patch =
                                        [&](const PatchVertices& v, Mesh& out, std::size_t job) {
                                            if (job >= jobs) in_range = false;
                                            for (std::size_t k = 0; k < v.index.size(); ++k)
                                                out.positions[v.index[k]] = Vec3f(v.points[k].jet.p);
                                        },
                                    .at_junction =
                                        [&](const JunctionVertices& v, Mesh& out, std::size_t job) {
                                            if (job >= jobs) in_range = false;
                                            for (std::uint32_t j = 0; j < v.count; ++j)
                                                out.positions[v.first_index + j] = Vec3f(v.points[j].jet.p);
                                        }});
            CHECK(in_range);
            return mesh;
        };
        const Mesh one = run(1), seven = run(7);
        CHECK(one.positions == seven.positions);
        CHECK(one.uvs == seven.uvs);
        CHECK(one.corner_position == seven.corner_position);
        CHECK(one.corner_uv == seven.corner_uv);
    }

} // TEST_SUITE
