#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/surface/patch/patch_locator.h"
#include "bake/surface/patch/surface_map.h"
#include "bake/surface/point/curvature.h"
#include "oracle/surfaces.h"
#include "surface/analytic/shapes.h"
#include <cstring>
#include <doctest/doctest.h>

using namespace bake;
using doctest::Approx;
using oracle::angle_deg;

namespace {

struct Maps {
    std::vector<Image<float>> images; ///< in the order of all_map_quantities
    SurfaceMapReport report;
    Vec3d vector(MapQuantity q, int x, int y) const {
        const float* v = &images[std::size_t(q)].at(x, y);
        return {v[0], v[1], v[2]};
    }
    double value(MapQuantity q, int x, int y, int c = 0) const { return images[std::size_t(q)].at(x, y, c); }
};

Maps maps_of(const BaseSurface& surface, SurfaceKind kind, int rate, const SurfaceMapOptions& options) {
    Maps out;
    const SurfaceMesh mesh = surface_mesh(surface, kind, rate);
    out.images = surface_maps(surface, mesh, all_map_quantities, options, "test", out.report);
    return out;
}
Maps shape_maps(const char* text, const SurfaceMapOptions& options) {
    const ParametricSurface shape(text);
    const auto [columns, rows] = shape.default_resolution();
    return maps_of(BaseSurface(shape, columns, rows), SurfaceKind::shape, 1, options);
}

Vec2d centre(int x, int y, int width, int height) { return {(x + 0.5) / width, 1 - (y + 0.5) / height}; }

/// A cage of a bent sheet whose uvs are no linear function of anything.
Mesh sheet_cage(int n) {
    Mesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double x = double(i) / n, y = double(j) / n;
            mesh.positions.emplace_back(x, 0.3 * std::sin(3 * x) * std::cos(2 * y), -y);
            mesh.uvs.emplace_back(0.1 + 0.7 * x + 0.08 * std::sin(3 * y), 0.1 + 0.75 * y + 0.06 * std::sin(4 * x));
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            for (const auto& [a, b] : {std::pair(i, j), {i + 1, j}, {i + 1, j + 1}, {i, j + 1}})
                mesh.corner_position.push_back(std::uint32_t(b * (n + 1) + a));
            mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
        }
    mesh.corner_uv = mesh.corner_position;
    return mesh;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("surface_map: every map of a torus is its closed form at the texels' centres") {
        const int width = 64, height = 40;
        const Maps maps = shape_maps("torus:R=2,r=0.7", {.width = width, .height = height});
        CHECK(maps.report.covered == width * height);
        CHECK(maps.report.border + maps.report.empty + maps.report.padded + maps.report.degenerate == 0);
        CHECK(maps.report.residual < 1e-12);
        const auto up = [](const Vec3d& a) { return Vec3d(a.x, a.z, -a.y); };
        double worst = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Vec2d uv = centre(x, y, width, height);
                const Jet<double> want = oracle::torus(2, 0.7, 2 * pi * uv.x, 2 * pi * uv.y);
                const double ring = std::cos(2 * pi * uv.y) / (2 + 0.7 * std::cos(2 * pi * uv.y));
                using enum MapQuantity;
                const auto off = [&](MapQuantity q, const Vec3d& a) {
                    worst = std::max(worst, glm::length(maps.vector(q, x, y) - a) / std::max(1.0, glm::length(a)));
                };
                off(position, up(want.p));
                off(normal, up(want.n));
                off(p_u, 2 * pi * up(want.p_u));
                off(p_v, 2 * pi * up(want.p_v));
                off(tangent, glm::normalize(up(want.p_u)));
                worst = std::max({worst, std::abs(maps.value(mean_curvature, x, y) - (ring + 1 / 0.7) / 2),
                                  std::abs(maps.value(gauss_curvature, x, y) - ring / 0.7),
                                  std::abs(maps.value(tangent, x, y, 3) - 1)});
            }
        CHECK(worst < 3e-7); // floats
    }

    TEST_CASE("surface_map: a sphere's maps hold up to the texels at its poles") {
        const Maps maps = shape_maps("sphere:R=2", {.width = 32, .height = 256});
        for (const int y : {0, 1, 128, 255})
            for (int x = 0; x < 32; ++x) {
                const Vec2d uv = centre(x, y, 32, 256);
                const double latitude = pi * (uv.y - 0.5);
                CHECK(angle_deg(maps.vector(MapQuantity::normal, x, y), maps.vector(MapQuantity::position, x, y)) <
                      1e-5);
                CHECK(maps.value(MapQuantity::mean_curvature, x, y) == Approx(0.5));
                CHECK(maps.value(MapQuantity::gauss_curvature, x, y) == Approx(0.25));
                CHECK(glm::length(maps.vector(MapQuantity::p_u, x, y)) == Approx(4 * pi * std::cos(latitude)));
            }
        CHECK(maps.report.degenerate == 0);
    }

    TEST_CASE("surface_map: a limit's texels are where its uv is the texel's centre") {
        const Mesh cage = sheet_cage(5);
        const BaseSurface surface(cage, SubdivisionOptions{});
        const int size = 96;
        const Maps maps = maps_of(surface, SurfaceKind::limit, 3, {.width = size, .height = size});
        CHECK(maps.report.residual < 1e-9);
        CHECK(maps.report.covered > size * size / 2);
        CHECK(maps.report.border > 0);
        CHECK(maps.report.border < 8 * size);
        // The same point found from all over the surface: from a dense lattice of it, the nearest in uv, then by its tangents.
        std::vector<SurfacePoint> dense;
        const int rate = 24;
        std::vector<SurfacePoint> lattice((rate + 1) * (rate + 1));
        for (std::uint32_t p = 0; p < surface.complex().patches.size(); ++p) {
            surface.evaluate_lattice(p, rate, lattice);
            dense.insert(dense.end(), lattice.begin(), lattice.end());
        }
        double worst = 0;
        for (int y = 30; y < 70; y += 7)
            for (int x = 30; x < 70; x += 7) {
                const Vec2d uv = centre(x, y, size, size);
                const SurfacePoint& near =
                    *std::min_element(dense.begin(), dense.end(), [&](const SurfacePoint& a, const SurfacePoint& b) {
                        return glm::length(a.uv - uv) < glm::length(b.uv - uv);
                    });
                const Vec2d d = uv - near.uv;
                const double area = near.uv_s.x * near.uv_t.y - near.uv_t.x * near.uv_s.y;
                const double s = (d.x * near.uv_t.y - d.y * near.uv_t.x) / area,
                             t = (d.y * near.uv_s.x - d.x * near.uv_s.y) / area;
                worst = std::max(worst, glm::length(maps.vector(MapQuantity::position, x, y) -
                                                    (near.jet.p + s * near.jet.p_u + t * near.jet.p_v)));
            }
        CHECK(worst < 1e-4); // second order: a step of 1/48 of a patch squared, times curvature
        // p_u by differences along the map itself.
        for (int y = 30; y < 70; y += 7) {
            const Vec3d difference =
                (maps.vector(MapQuantity::position, 51, y) - maps.vector(MapQuantity::position, 49, y)) * (size / 2.0);
            CHECK(glm::length(maps.vector(MapQuantity::p_u, 50, y) - difference) < 2e-3);
        }
    }

    TEST_CASE("surface_map: a mesh's maps say what its jets say") {
        const Mesh mesh = oracle::torus_mesh(128, 64, true);
        const Maps maps = maps_of(BaseSurface(mesh), SurfaceKind::mesh, 1, {.width = 50, .height = 50});
        CHECK(maps.report.covered == 2500);
        for (int y = 0; y < 50; y += 3)
            for (int x = 0; x < 50; x += 3) {
                const Vec2d uv = centre(x, y, 50, 50);
                const Jet<double> want = oracle::torus(1, 0.4, 2 * pi * uv.x, 2 * pi * uv.y);
                // Facets of 128 x 64: chords of 2.8 and 5.6 degrees.
                CHECK(glm::length(maps.vector(MapQuantity::position, x, y) - want.p) < 2e-3);
                CHECK(angle_deg(maps.vector(MapQuantity::normal, x, y), want.n) < 0.05);
                CHECK(glm::length(maps.vector(MapQuantity::p_u, x, y) - 2 * pi * want.p_u) < 0.02);
                const double ring = std::cos(2 * pi * uv.y) / (1 + 0.4 * std::cos(2 * pi * uv.y));
                CHECK(maps.value(MapQuantity::mean_curvature, x, y) == Approx((ring + 2.5) / 2).epsilon(0.02));
            }
    }
}

TEST_SUITE("unit") {

    TEST_CASE("patch_locator: finds its way back from another patch") {
        const BaseSurface surface(sheet_cage(6), SubdivisionOptions{});
        const PatchLocator locator(surface);
        const auto patches = std::uint32_t(surface.complex().patches.size());
        double worst = 0;
        for (std::uint32_t p = 0; p < patches; ++p)
            for (const Vec2d st : {Vec2d(0.3, 0.9), Vec2d(0.5, 0.5), Vec2d(0, 0.25), Vec2d(1, 1)}) {
                SurfacePoint want;
                surface.evaluate(p, {&st, 1}, {&want, 1});
                for (const std::uint32_t from : {p, (p + 1) % patches, (p + 7) % patches}) {
                    if (from != p && (from % 6 == 0 || p % 6 == 0)) continue; // no neighbour, the next row's start
                    const Located at = locator.locate(want.uv, from, {0.2, 0.1});
                    worst = std::max({worst, at.residual, glm::length(at.point.jet.p - want.jet.p)});
                }
            }
        CHECK(worst < 1e-12);
    }

    TEST_CASE("patch_locator: beyond the chart it ends at the border, and at no place worse than the guess") {
        const BaseSurface surface(sheet_cage(4), SubdivisionOptions{});
        const PatchLocator locator(surface);
        const Located at = locator.locate({-0.2, 0.5}, 5, {0.5, 0.5});
        CHECK(at.point.uv.x < 0.25);
        CHECK(at.st.x >= 0);
        CHECK(at.st.x <= 1);
        CHECK(at.residual < 0.5);
    }

    TEST_CASE("patch_locator: bilinear uvs are inverted") {
        const Vec2d uv[4] = {{0.1, 0.1}, {0.9, 0.2}, {0.7, 0.8}, {0.2, 0.6}};
        for (double s : {0.0, 0.3, 1.0})
            for (double t : {0.0, 0.6, 1.0}) {
                const Vec2d at = (1 - s) * (1 - t) * uv[0] + s * (1 - t) * uv[1] + s * t * uv[2] + (1 - s) * t * uv[3];
                CHECK(glm::length(invert_bilinear(uv, at, {0.5, 0.5}) - Vec2d(s, t)) < 1e-12);
            }
        const Vec2d point[4] = {{0.1, 0.1}, {0.1, 0.1}, {0.1, 0.1}, {0.1, 0.1}};
        CHECK(invert_bilinear(point, {0.1, 0.1}, {0.5, 0.5}) == Vec2d(0.5, 0.5));
    }

    TEST_CASE("surface_map: mirrored charts have sigma -1 beside the same normal and curvature") {
        Mesh mesh = oracle::torus_mesh(32, 16, true);
        const Maps straight = maps_of(BaseSurface(mesh), SurfaceKind::mesh, 1, {.width = 16, .height = 16});
        for (Vec2f& uv : mesh.uvs) uv.x = 1 - uv.x;
        const Maps mirrored = maps_of(BaseSurface(mesh), SurfaceKind::mesh, 1, {.width = 16, .height = 16});
        CHECK(straight.value(MapQuantity::tangent, 3, 5, 3) == 1);
        CHECK(mirrored.value(MapQuantity::tangent, 12, 5, 3) == -1);
        CHECK(angle_deg(straight.vector(MapQuantity::normal, 3, 5), mirrored.vector(MapQuantity::normal, 12, 5)) <
              1e-4);
        CHECK(glm::length(straight.vector(MapQuantity::p_u, 3, 5) + mirrored.vector(MapQuantity::p_u, 12, 5)) < 1e-4);
        CHECK(mirrored.value(MapQuantity::mean_curvature, 12, 5) ==
              Approx(straight.value(MapQuantity::mean_curvature, 3, 5)).epsilon(1e-4));
    }

    TEST_CASE("surface_map: texels outside the charts are padded, then zero, and all are counted") {
        Mesh mesh = sheet_cage(3);
        for (Vec2f& uv : mesh.uvs) uv *= 0.5f;
        const Maps maps = maps_of(BaseSurface(mesh), SurfaceKind::mesh, 1, {.width = 64, .height = 64, .padding = 2});
        const SurfaceMapReport& r = maps.report;
        CHECK(r.covered > 400);
        CHECK(r.padded > 100);
        CHECK(r.empty > 1000);
        CHECK(r.covered + r.border + r.padded + r.empty == 64 * 64);
        CHECK(maps.vector(MapQuantity::normal, 63, 0) == Vec3d(0));
        std::int64_t zeros = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) zeros += maps.vector(MapQuantity::normal, x, y) == Vec3d(0);
        CHECK(zeros == r.empty);
    }

    TEST_CASE("surface_map: names and channels") {
        CHECK(std::string(name(MapQuantity::p_u)) == "pu");
        CHECK(std::string(name(MapQuantity::gauss_curvature)) == "gauss-curvature");
        CHECK(channels(MapQuantity::tangent) == 4);
        CHECK(channels(MapQuantity::mean_curvature) == 1);
    }
}

TEST_SUITE("stability") {

    TEST_CASE("surface_map: no uvs, or uvs without area, are refused; charts in another tile are not") {
        const auto refusal = [](Mesh mesh) {
            try {
                maps_of(BaseSurface(std::move(mesh)), SurfaceKind::mesh, 1, {.width = 8, .height = 8});
                return std::string("taken");
            } catch (const Error& error) {
                return std::to_string(int(error.refusal)) + " " + error.what();
            }
        };
        Mesh mesh = sheet_cage(2);
        for (Vec2f& uv : mesh.uvs) uv += 3.0f;
        CHECK(refusal(mesh) == "taken");
        for (Vec2f& uv : mesh.uvs) uv = Vec2f(0.5f);
        CHECK(refusal(mesh).starts_with("4 test: no face has area in its uvs"));
        mesh.corner_uv.clear(), mesh.uvs.clear();
        CHECK(refusal(mesh).starts_with("4 test: has no uvs"));
    }

    TEST_CASE("surface_map: faces without area in uv leave no NaN, and their neighbours the map") {
        Mesh mesh = sheet_cage(4);
        for (int k = 0; k < 4; ++k)
            mesh.uvs[std::size_t(mesh.corner_uv[std::size_t(20 + k)])] = mesh.uvs[mesh.corner_uv[20]];
        for (const SurfaceKind kind : {SurfaceKind::mesh, SurfaceKind::limit}) {
            const BaseSurface surface =
                kind == SurfaceKind::mesh ? BaseSurface(mesh) : BaseSurface(mesh, SubdivisionOptions{});
            const Maps maps = maps_of(surface, kind, 2, {.width = 40, .height = 40});
            double sum = 0;
            for (const Image<float>& image : maps.images)
                for (std::size_t i = 0; i < image.size(); ++i) sum += image.data()[i] * 0.0;
            CHECK(sum == 0);
            CHECK(maps.report.covered > 500);
        }
    }

    TEST_CASE("surface_map: the same bytes for 1, 2 and 7 threads") {
        const BaseSurface surface(sheet_cage(4), SubdivisionOptions{});
        std::vector<Maps> all;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            all.push_back(maps_of(surface, SurfaceKind::limit, 3, {.width = 48, .height = 48}));
        }
        for (std::size_t k = 1; k < all.size(); ++k)
            for (std::size_t q = 0; q < all[0].images.size(); ++q)
                CHECK(std::memcmp(all[0].images[q].data(), all[k].images[q].data(),
                                  all[0].images[q].size() * sizeof(float)) == 0);
    }

    TEST_CASE("surface_map: one texel is the middle of the chart") {
        const Maps maps = shape_maps("sphere", {.width = 1, .height = 1});
        CHECK(glm::length(maps.vector(MapQuantity::position, 0, 0) - Vec3d(-1, 0, 0)) < 1e-7);
    }
}
