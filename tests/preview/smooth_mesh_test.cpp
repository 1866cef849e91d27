#include "bake/base/error.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/preview/relief_method.h"
#include "bake/preview/scene_io.h"
#include "bake/preview/shape_mesh.h"
#include "bake/preview/smooth_mesh.h"
#include "cli/command.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

HeightTexture level(float value) {
    HeightTexture height;
    height.values = Image<float>(8, 8, 1);
    for (std::size_t i = 0; i < height.values.size(); ++i) height.values.data()[i] = value;
    height.info.type = SampleType::float32;
    return height;
}

/// Smallest and largest distance of points from the origin.
std::pair<double, double> distances(const Mesh& mesh) {
    double least = 1e9, most = 0;
    for (const Vec3f& p : mesh.positions) {
        const double d = glm::length(Vec3d(p));
        least = std::min(least, d), most = std::max(most, d);
    }
    return {least, most};
}

Mesh displaced(const Shape& shape, const HeightTexture& height) {
    ReliefModel model =
        with_relief(Material{}, shape, height,
                    {.method = parse_shade("displace:4").value(), .height = {.amplitude = 1, .midlevel = 0}});
    return std::move(model.shape->mesh);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("smooth_mesh: a coarse sphere is displaced from the sphere itself, not from its facets") {
        const auto shape = make_shape(shape_mesh("sphere:R=1", 12, 6));
        const HeightTexture height = level(0.25f);
        CHECK(distances(displaced(*shape, height)).first < 1.24);
        shape->smooth = shape_surface("sphere:R=1", 12, 6);
        const auto [least, most] = distances(displaced(*shape, height));
        CHECK(least == doctest::Approx(1.25).epsilon(1e-5));
        CHECK(most == doctest::Approx(1.25).epsilon(1e-5));
        CHECK(shape_surface("cube:a=2", 1, 1) == nullptr);
    }

    TEST_CASE("smooth_mesh: the limit of a cage is cut as asked, lies inside it, and is what gets displaced") {
        const Mesh cage = read_mesh(own_meshes() / "torus.obj");
        const SmoothMesh two = limit_mesh(Mesh(cage), Scheme::catmark, "torus.obj", 2);
        CHECK(two.mesh.faces() == 4 * cage.faces());
        const SmoothMesh four = limit_mesh(Mesh(cage), Scheme::catmark, "torus.obj", 4);
        CHECK(four.mesh.faces() == 16 * cage.faces());
        CHECK(distances(two.mesh).second < distances(cage).second);
        // Points of the coarse mesh are points of the fine one: both lie on the limit.
        const auto [least, most] = distances(four.mesh);
        CHECK(distances(two.mesh).first >= least - 1e-6);
        CHECK(distances(two.mesh).second <= most + 1e-6);
        auto shape = make_shape(Mesh(two.mesh));
        shape->smooth = two.surface;
        CHECK(displaced(*shape, level(0)).faces() == 16 * cage.faces());
    }

    TEST_CASE("smooth_mesh: subdivide and segments of a scene") {
        const Folder folder;
        const std::string torus = own_meshes() / "torus.obj";
        const auto scene = [&](const std::string& keys) {
            write_file(folder / "s.toml", "[[mesh]]\nfile = \"" + torus + "\"\n" + keys);
            return load(read_scene(folder / "s.toml"));
        };
        const std::size_t faces = scene("").shapes.at(0)->mesh.faces();
        CHECK(scene("subdivide = \"none\"\n").shapes.at(0)->mesh.faces() == faces);
        CHECK(scene("subdivide = \"catmark\"\nsegments = 3\n").shapes.at(0)->mesh.faces() == 9 * faces);
        CHECK_THROWS_AS(scene("segments = 3\n"), Error);
        CHECK_THROWS_AS(scene("subdivide = \"loop\"\n"), Error); // quads
    }

} // TEST_SUITE
