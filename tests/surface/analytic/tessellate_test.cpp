// Tessellations of analytic shapes.
#include "bake/base/error.h"
#include "bake/surface/analytic/parametric.h"
#include "surface/analytic/shapes.h"
#include "surface/manifold.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;
using bake_tests::Shapes;

TEST_SUITE("unit") {

    TEST_CASE("parametric: tessellations of closed shapes are closed manifolds that face outward") {
        const Shapes shapes;
        for (const std::string& text : shapes.closed()) {
            INFO(text);
            const ParametricSurface s(text);
            CHECK(s.closed());
            const Mesh mesh = tessellate(s, 12, 10);
            const Manifold m = manifold(without_repeats(mesh));
            CHECK(m.boundary == 0);
            CHECK(m.crowded == 0);
            CHECK(m.against == 0);
            CHECK(m.euler() == (s.closure_v() == Closure::periodic ? 0 : 2));
            CHECK(volume(mesh) > 0);
            for (std::size_t c = 0; c < mesh.corners(); ++c)
                CHECK(std::abs(glm::length(mesh.normals[mesh.corner_normal[c]]) - 1) < 1e-6f);
        }
    }

    TEST_CASE("parametric: tessellations of one-sided shapes have no crack, and one seam where faces have opposite "
              "orientation") {
        const Manifold strip = manifold(tessellate(ParametricSurface("moebius"), 24, 4));
        CHECK(strip.euler() == 0);
        CHECK(strip.boundary == 2 * 24); // one border that goes around twice
        CHECK(strip.crowded == 0);
        CHECK(strip.against == 4);
        const Manifold bottle = manifold(tessellate(ParametricSurface("klein"), 24, 12));
        CHECK(bottle.euler() == 0);
        CHECK(bottle.boundary == 0);
        CHECK(bottle.crowded == 0);
        CHECK(bottle.against == 12);
        CHECK_FALSE(ParametricSurface("klein").closed());
    }

    TEST_CASE("parametric: tessellations of open shapes have no other boundary than that of the shape") {
        const Shapes shapes;
        const std::map<std::string, std::size_t> borders = {{"plane:w=2,d=3", 44},
                                                            {"disc:R=1.5", 12},
                                                            {"cylinder:R=0.7,h=3", 24},
                                                            {"cone:R=1,h=1.5", 12},
                                                            {"saddle:R=1,h=0.4", 44}};
        for (const auto& [text, border] : borders) {
            INFO(text);
            const Manifold m = manifold(without_repeats(tessellate(ParametricSurface(text), 12, 10)));
            CHECK(m.boundary == border);
            CHECK(m.crowded + m.against == 0);
        }
        CHECK_FALSE(ParametricSurface("revolution:profile=" + shapes.vase_file).closed());
    }

    TEST_CASE("parametric: the vertices of a tessellation are points of the surface at their uv, with its normals") {
        const Shapes shapes;
        for (const std::string& text : shapes.all()) {
            INFO(text);
            const ParametricSurface s(text);
            const Mesh mesh = tessellate(s, 7, 5);
            const std::size_t per_patch = mesh.faces() / std::size_t(s.patches());
            CHECK(per_patch == 35);
            double p_error = 0, n_error = 0;
            for (std::size_t f = 0; f < mesh.faces(); ++f)
                for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
                    const Vec2d uv(mesh.uvs[mesh.corner_uv[c]]);
                    const Jet<double> jet = s.jet(uv.x, uv.y, int(f / per_patch));
                    p_error = std::max(p_error, glm::length(Vec3d(mesh.positions[mesh.corner_position[c]]) - jet.p));
                    if (jet.sigma != 0)
                        n_error = std::max(n_error, glm::length(Vec3d(mesh.normals[mesh.corner_normal[c]]) - jet.n));
                }
            CHECK(p_error < 2e-6); // float uvs, positions and slopes up to 20
            CHECK(n_error < 2e-5);
        }
    }

    TEST_CASE("parametric: faces are in row order, with corners (i,j) (i+1,j) (i+1,j+1) (i,j+1)") {
        const Mesh mesh = tessellate(ParametricSurface("plane"), 3, 2);
        CHECK(mesh.faces() == 6);
        const auto uv = [&](std::uint32_t c) { return mesh.uvs[mesh.corner_uv[c]]; };
        CHECK(uv(4 * 4) == Vec2f(1.f / 3, 0.5f)); // face 4 = 1 * 3 + 1
        CHECK(uv(4 * 4 + 1) == Vec2f(2.f / 3, 0.5f));
        CHECK(uv(4 * 4 + 2) == Vec2f(2.f / 3, 1));
        CHECK(uv(4 * 4 + 3) == Vec2f(1.f / 3, 1));
    }

    TEST_CASE("parametric: patches with unequal cells share borders along the same parameter") {
        const Shapes shapes;
        const ParametricSurface s("bezier:file=" + shapes.octants_file);
        CHECK(s.patches() == 8);
        for (const auto& [columns, rows] : {std::pair(1, 1), {1, 4}, {5, 3}, {4, 4}}) {
            const Manifold m = manifold(without_repeats(tessellate(s, columns, rows)));
            CHECK(m.boundary == 0);
            CHECK(m.euler() == 2);
        }
    }

    TEST_CASE("parametric: flip reverses the normals of a patch") {
        const Shapes shapes;
        const ParametricSurface s("bezier:file=" + shapes.octants_file),
            flipped("bezier:flip=1,file=" + shapes.octants_file);
        CHECK(volume(tessellate(s, 8, 8)) == doctest::Approx(4.19).epsilon(0.02));
        CHECK(volume(tessellate(flipped, 8, 8)) == doctest::Approx(-4.19).epsilon(0.02));
        CHECK(glm::length(s.jet(0.3, 0.4, 1).n + flipped.jet(0.7, 0.4, 1).n) < 1e-14);
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("parametric: resolutions that cannot close a shape, or need too much memory, are refused") {
        const auto refused = [](const char* shape, int columns, int rows) {
            try {
                tessellate(ParametricSurface(shape), columns, rows);
                return 0;
            } catch (const Error& error) {
                return int(error.refusal);
            }
        };
        CHECK(refused("plane", 0, 1) == 2);
        CHECK(refused("plane", 1, -1) == 2);
        CHECK(refused("sphere", 2, 5) == 2);
        CHECK(refused("torus", 3, 2) == 2);
        CHECK(refused("plane", 1 << 20, 1 << 20) == 2);
        CHECK(refused("torus", 3, 3) == 0);
        CHECK(refused("sphere", 3, 1) == 0);
        CHECK(refused("plane", 1, 1) == 0);
    }

} // TEST_SUITE
