#include "bake/relief/map/texel_row.h"
#include "bake/surface/chart/tangent_space.h"
#include "relief/map/torus_relief.h"
#include <algorithm>
#include <cstring>
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// The texel by the functions of displaced_normal.h, in double precision; 0 where it has no normal.
Vec3d by_definition(const BakeTarget& target, const TexelHit& hit, const Height<float>& h,
                    const NormalMapOptions& options) {
    const Jet<double> jet = jet_at<double>(target.surface, hit.triangle, hit.b1, hit.b2);
    const bool folded = folds(jet, double(h.b));
    const NormalMethod method = folded && options.method == NormalMethod::exact ? NormalMethod::blinn : options.method;
    const Vec3d normal = unit_or_zero(displaced_normal(jet, Height<double>{h.b, h.b_u, h.b_v}, method,
                                                       ConstantScale<double>{target.scale.u, target.scale.v}));
    if (options.space == Space::object || normal == Vec3d(0)) return normal;
    const auto& corner = target.surface.triangles[hit.triangle].corner;
    const double b[3] = {1.0 - hit.b1 - hit.b2, hit.b1, hit.b2};
    Vec3d T(0), N(0);
    for (int k = 0; k < 3; ++k)
        T += b[k] * Vec3d(Vec3f(target.tangents[corner[k]])), N += b[k] * Vec3d(target.surface.n[corner[k]]);
    const double sign = target.tangents[corner[0]].w;
    const Vec3d B = sign * glm::cross(N, T);
    // The coordinates of the normal in the frame T, B, N, by Cramer's rule.
    return unit_or_zero(Vec3d(glm::dot(normal, glm::cross(B, N)), glm::dot(normal, glm::cross(N, T)),
                              glm::dot(normal, glm::cross(T, B))) *
                        sign);
}

struct Rows {
    Image<float> map;
    Image<unsigned char> owned;
    TexelCounts counts;
};

Rows bake_rows(const BakeTarget& target, const NormalMapOptions& options, const std::vector<Height<float>>& heights) {
    const int width = target.raster.hits.width(), height = target.raster.hits.height();
    Rows out{Image<float>(width, height, 3), Image<unsigned char>(width, height, 1), {}};
    TexelRow row(target, options);
    for (int y = 0; y < height; ++y)
        row.bake(y, heights.data() + std::size_t(y) * width, out.map.row(y), out.owned.row(y));
    out.counts = row.counts();
    return out;
}

/// Heights and slopes of a relief that is not periodic in the blocks of a row.
std::vector<Height<float>> some_heights(int width, int height, float amplitude) {
    std::vector<Height<float>> heights(std::size_t(width) * height);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const float phase = float(i % 7919);
        heights[i] = {amplitude * std::sin(0.37f * phase), 20 * amplitude * std::cos(0.61f * phase),
                      20 * amplitude * std::sin(1.13f * phase)};
    }
    return heights;
}

/// The torus, with u mirrored and the triangles turned where `mirrored`.
Mesh torus(int columns, int rows, bool mirrored) {
    Mesh mesh = oracle::torus_mesh(columns, rows);
    if (mirrored)
        for (Vec2f& uv : mesh.uvs) uv.x = 1 - uv.x;
    return mesh;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE(
        "texel_row: every texel is the displaced normal in its frame, whatever the runs, blocks, method and space") {
        // Triangles larger than a block of texels, of a few texels, and smaller than one.
        for (const auto& [columns, rows] : {std::pair(6, 4), {40, 24}, {150, 100}})
            for (const bool mirrored : {false, true}) {
                const Mesh mesh = torus(columns, rows, mirrored);
                const BakeTarget target = make_bake_target(mesh, "torus", 201, 97);
                const auto heights = some_heights(201, 97, 0.02f);
                for (const NormalMethod method : all_normal_methods)
                    for (const Space space : {Space::tangent, Space::object}) {
                        const NormalMapOptions options{.method = method, .space = space, .directx = mirrored};
                        const Rows rows_baked = bake_rows(target, options, heights);
                        double worst = 0;
                        for (int y = 0; y < 97; ++y)
                            for (int x = 0; x < 201; ++x) {
                                const Vec3d t = by_definition(target, target.raster.hits.at(x, y),
                                                              heights[std::size_t(y) * 201 + x], options);
                                const Vec3f got = decode_normal({rows_baked.map.at(x, y, 0), rows_baked.map.at(x, y, 1),
                                                                 rows_baked.map.at(x, y, 2)},
                                                                mirrored);
                                worst = std::max(worst, glm::length(Vec3d(got) - t));
                                CHECK(rows_baked.owned.at(x, y) == 1);
                            }
                        CAPTURE(std::string(name(method)));
                        // Encoding rounds at 6e-8; products of interpolated vectors lose a few bits more.
                        CHECK(worst < 2e-6);
                        CHECK(rows_baked.counts.degenerate == 0);
                    }
            }
    }
}

TEST_SUITE("unit") {

    TEST_CASE("texel_row: texels that fold are counted, and take blinn's normal for exact") {
        const Mesh mesh = torus(40, 24, false);
        const BakeTarget target = make_bake_target(mesh, "torus", 120, 64);
        std::vector<Height<float>> heights = some_heights(120, 64, 0.02f);
        for (std::size_t i = 0; i < heights.size(); i += 3) heights[i].b = -0.5f; // the tube's radius is 0.4
        const NormalMapOptions exact, blinn{.method = NormalMethod::blinn};
        const Rows a = bake_rows(target, exact, heights), b = bake_rows(target, blinn, heights);
        std::int64_t folded = 0;
        double worst = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 120; ++x) {
                const TexelHit& hit = target.raster.hits.at(x, y);
                const Height<float>& h = heights[std::size_t(y) * 120 + x];
                if (!folds(jet_at<float>(target.surface, hit.triangle, hit.b1, hit.b2), h.b)) continue;
                ++folded;
                for (int c = 0; c < 3; ++c)
                    worst = std::max(worst, double(std::abs(a.map.at(x, y, c) - b.map.at(x, y, c))));
            }
        CHECK(folded >= 120 * 64 / 3);
        CHECK(a.counts.folded == folded);
        CHECK(b.counts.folded == folded);
        CHECK(worst < 1e-6);
    }

    TEST_CASE("texel_row: empty texels and triangles without a normal are flat and not owned") {
        Mesh mesh = torus(12, 8, false);
        for (Vec2f& uv : mesh.uvs) uv = 0.5f * uv;
        for (Vec3f& n : mesh.normals) n = Vec3f(0);
        for (Vec3f& p : mesh.positions) p = Vec3f(0);
        const BakeTarget target = make_bake_target(mesh, "torus", 90, 40);
        const Rows rows = bake_rows(target, {}, some_heights(90, 40, 0.02f));
        CHECK(rows.counts.degenerate == target.raster.covered + target.raster.border);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 90; ++x) {
                CHECK(rows.owned.at(x, y) == 0);
                CHECK(rows.map.at(x, y, 0) == 0.5f);
                CHECK(rows.map.at(x, y, 1) == 0.5f);
                CHECK(rows.map.at(x, y, 2) == 1.0f);
            }
    }

    TEST_CASE("texel_row: where the mesh has no width there is no normal, although the displaced surface has one") {
        // A rectangle that is squeezed to a line, whose normals open like a fan.
        Mesh mesh;
        mesh.face_begin = {0, 4};
        mesh.positions = {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 1, 0}};
        mesh.normals = {{-0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}};
        mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        mesh.corner_position = mesh.corner_normal = mesh.corner_uv = {0, 1, 2, 3};
        const BakeTarget target = make_bake_target(mesh, "fan", 32, 16);
        const std::vector<Height<float>> heights(32 * 16, Height<float>{0.5f, 0, 0});
        const Rows rows = bake_rows(target, {}, heights);
        CHECK(rows.counts.degenerate == 32 * 16);
        CHECK(std::count(rows.owned.data(), rows.owned.data() + rows.owned.size(), 0) == 32 * 16);
    }

    TEST_CASE("texel_row: meshes of any size and slopes of any steepness have unit normals") {
        for (const float size : {1e-12f, 1e-4f, 1e6f, 1e12f})
            for (const float slope : {0.0f, 1.0f, 1e15f, 1e24f}) {
                Mesh mesh = torus(12, 8, false);
                for (Vec3f& p : mesh.positions) p *= size;
                const BakeTarget target = make_bake_target(mesh, "torus", 32, 16);
                const std::vector<Height<float>> heights(32 * 16, Height<float>{0, slope * size, -slope * size});
                const Rows rows = bake_rows(target, {}, heights);
                for (int y = 0; y < 16; ++y)
                    for (int x = 0; x < 32; ++x) {
                        const Vec3f t =
                            decode_normal({rows.map.at(x, y, 0), rows.map.at(x, y, 1), rows.map.at(x, y, 2)}, false);
                        CHECK(glm::length(t) == doctest::Approx(1).epsilon(1e-5));
                    }
            }
    }

} // TEST_SUITE
