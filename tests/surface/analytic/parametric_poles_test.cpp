// Points where p_u x p_v = 0: poles, tips, collapsed edges.
#include "bake/surface/analytic/parametric.h"
#include "oracle/surfaces.h"
#include "surface/analytic/shapes.h"
#include "surface/manifold.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;
using bake_tests::Shapes;

TEST_SUITE("stability") {

    TEST_CASE("parametric: poles of sphere, ellipsoid and superellipsoid have their limit normal") {
        for (const char* text :
             {"sphere:R=3", "ellipsoid:a=3,b=1,c=0.4", "superellipsoid:e1=0.1,e2=0.3", "superellipsoid:e1=1,e2=0.05"}) {
            const ParametricSurface s(text);
            INFO(text);
            for (double u : {0.0, 0.1, 0.25, 0.7, 1.0}) {
                CHECK(s.pole(u, 0) == Pole::with_normal);
                CHECK(s.pole(u, 1) == Pole::with_normal);
                CHECK(s.pole(u, 0.5) == Pole::none);
                const Jet<double> top = s.jet(u, 1), bottom = s.jet(u, 0);
                CHECK(top.sigma == 0);
                CHECK(top.n_u == Vec3d(0));
                CHECK(glm::length(top.n - Vec3d(0, 1, 0)) < 1e-12);
                CHECK(glm::length(bottom.n - Vec3d(0, -1, 0)) < 1e-12);
                CHECK(top.p == s.jet(0, 1).p);
            }
        }
    }

    TEST_CASE("parametric: a disc's centre has the disc's normal") {
        const ParametricSurface s("disc:R=2");
        CHECK(s.pole(0.3, 1) == Pole::with_normal);
        CHECK(glm::length(s.jet(0.3, 1).n - Vec3d(0, 1, 0)) < 1e-12);
        CHECK(s.pole(0.3, 0) == Pole::none);
    }

    TEST_CASE("parametric: a cone's apex has no normal, but each meridian has a limit") {
        const ParametricSurface s("cone:R=1,h=1");
        for (double u : {0.0, 0.2, 0.5}) {
            CHECK(s.pole(u, 1) == Pole::without_normal);
            CHECK(s.jet(u, 1).n == Vec3d(0));
            CHECK(s.jet(u, 1).sigma == 0);
            CHECK(glm::length(s.side_normal(u, 1) - s.jet(u, 0.5).n) < 1e-12);
        }
        CHECK(ParametricSurface("cone:R=1,h=1,r=0.5").pole(0, 1) == Pole::none);
        // One apex with a unit normal per meridian.
        const Mesh mesh = tessellate(s, 8, 2);
        CHECK(manifold(without_repeats(mesh)).boundary == 8);
        for (const Vec3f& n : mesh.normals) CHECK(glm::length(n) == doctest::Approx(1));
    }

    TEST_CASE("parametric: ends of a revolution on the axis are smooth, or pointed if requested") {
        const Shapes shapes;
        const ParametricSurface s("revolution:profile=" + shapes.drop_file),
            point("revolution:pointed=1,profile=" + shapes.drop_file);
        CHECK(s.pole(0.2, 0) == Pole::with_normal);
        CHECK(glm::length(s.jet(0.2, 0).n - Vec3d(0, -1, 0)) < 1e-12);
        CHECK(glm::length(s.jet(0.2, 1).n - Vec3d(0, 1, 0)) < 1e-12);
        CHECK(point.pole(0.2, 0) == Pole::without_normal);
        CHECK(point.pole(0.2, 1) == Pole::without_normal);
        const ParametricSurface vase("revolution:profile=" + shapes.vase_file);
        CHECK(vase.pole(0.2, 0) == Pole::with_normal);
        CHECK(vase.pole(0.2, 1) == Pole::none);
    }

    TEST_CASE("parametric: a patch with a collapsed edge has its limit normal there") {
        const Shapes shapes;
        const ParametricSurface s("bezier:file=" + shapes.octants_file);
        for (int patch = 0; patch < 8; ++patch) {
            const double v = patch < 4 ? 1 : 0;
            for (double u : {0.0, 0.3, 1.0}) {
                CHECK(s.pole(u, v, patch) == Pole::with_normal);
                CHECK(glm::length(s.jet(u, v, patch).n - Vec3d(0, patch < 4 ? 1 : -1, 0)) < 1e-12);
                CHECK(s.pole(u, 1 - v, patch) == Pole::none);
            }
        }
    }

    TEST_CASE("parametric: the tip of a pyramid has no limit normal, and a patch that is one point has none anywhere") {
        const Shapes shapes;
        std::string tip = "1\n", point = "1\n";
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) {
                const double r = (3 - j) / 3.0, x = std::cos(pi * i / 6), z = std::sin(pi * i / 6);
                tip += format("%.17g %g %.17g\n", r * x, j / 3.0, -r * z);
                point += "1 2 3\n";
            }
        const ParametricSurface s("bezier:file=" + shapes.folder.write("tip.txt", tip));
        CHECK(s.pole(0.4, 1) == Pole::without_normal);
        CHECK(s.pole(0.4, 0) == Pole::none);
        const ParametricSurface dot("bezier:file=" + shapes.folder.write("dot.txt", point));
        for (double u : {0.0, 0.5, 1.0}) {
            CHECK(dot.pole(u, 0.5) == Pole::without_normal);
            CHECK(dot.jet(u, 0.5).n == Vec3d(0));
        }
        CHECK(without_repeats(tessellate(dot, 4, 4)).faces() < 16);
    }

} // TEST_SUITE
