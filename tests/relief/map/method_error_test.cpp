#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/map/bake_budget.h"
#include "bake/relief/map/method_error.h"
#include "folders.h"
#include "relief/map/torus_relief.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// The largest angle between the maps of a method and of exact, over the texels that do not fold, in object space.
double largest_difference(const HeightField& field, const BakeTarget& target, NormalMapOptions options) {
    options.space = Space::object;
    NormalMapReport report;
    Image<unsigned char> owned(options.width, options.height, 1);
    const Image<float> own = bake_texels(field, target, options, owned, report);
    options.method = NormalMethod::exact;
    const Image<float> exact = bake_texels(field, target, options, owned, report);
    const HeightSampler<float> heights(field.values(), Interpolation::bilinear, options.height_options);
    double largest = 0;
    for (int y = 0; y < own.height(); ++y)
        for (int x = 0; x < own.width(); ++x) {
            const TexelHit& hit = target.raster.hits.at(x, y);
            if (!owned.at(x, y)) continue;
            const double u = (x + 0.5) / own.width(), v = 1 - (y + 0.5) / own.height();
            const Jet<double> jet = jet_at<double>(target.surface, hit.triangle, hit.b1, hit.b2);
            if (folds(jet, double(heights.at(float(u), float(v)).b))) continue;
            const auto n = [&](const Image<float>& map) {
                return 2.0 * Vec3d(map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)) - 1.0;
            };
            largest = std::max(largest, oracle::angle_deg(n(own), n(exact)));
        }
    return largest;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("method_error: nothing on a plane, where blinn is exact, and nothing of exact anywhere") {
        const oracle::TorusRelief r{0.05, 3, 2};
        const HeightTexture height = oracle::relief_texture(r, 64);
        NormalMapOptions options = oracle::relief_options(r, 64, Filter::c2, NormalMethod::blinn);
        const HeightField field(height, options.height_options, Filter::c2, 64, 64);
        const MethodError flat = method_error(plane_budget(height, field, options, {1, 1}, Depth::float32));
        CHECK(flat.largest_deg < 1e-5);
        CHECK(flat.bound_deg == 0);
        CHECK(flat.samples == 64 * 64);
        CHECK(describe(flat, NormalMethod::blinn) == "");
        const Mesh mesh = oracle::torus_mesh(32, 16);
        const BakeTarget target = make_bake_target(mesh, "torus", 64, 64);
        options.method = NormalMethod::exact;
        CHECK(method_error(mesh_budget(height, field, options, target, Depth::float32)).largest_deg == 0);
    }

    TEST_CASE("method_error: the sentence has the error and its cause") {
        MethodError error;
        error.largest_deg = 4.123, error.bend = 0.1312, error.stretch = 2.5, error.skew_deg = 12;
        CHECK(describe(error, NormalMethod::blinn) ==
              "blinn is off by up to 4.1 deg here: max |height x curvature| = 0.13");
        CHECK(describe(error, NormalMethod::constant_scale).find("stretched by a factor of up to 2.5") !=
              std::string::npos);
        error.largest_deg = 0.3;
        CHECK(describe(error, NormalMethod::blinn) == "");
    }
}

TEST_SUITE("oracle") {

    TEST_CASE("wrong_slope_bound_deg: the sphere's golden values, and no bound where the surface folds") {
        for (const auto& [x, deg] : {std::pair(0.01, 0.285), {0.1, 2.729}, {0.5, 11.54}, {-0.5, 19.47}})
            CHECK(wrong_slope_bound_deg(1 + x, 1 + x) == doctest::Approx(deg).epsilon(2e-3));
        CHECK(wrong_slope_bound_deg(0.995, 1.005) == doctest::Approx(glm::degrees(std::asin(0.005))).epsilon(1e-9));
        CHECK(wrong_slope_bound_deg(1, 1) == 0);
        CHECK(wrong_slope_bound_deg(-0.5, -0.5) == 180);
    }

    TEST_CASE("method_error: what is found at the slopes of a height is below the bound over all slopes") {
        const Mesh mesh = oracle::torus_mesh(64, 32);
        const BakeTarget target = make_bake_target(mesh, "torus", 128, 128);
        for (const double A : {0.002, 0.02, 0.1}) {
            const oracle::TorusRelief r{A, 5, 3};
            const HeightTexture height = oracle::relief_texture(r, 128);
            const NormalMapOptions options = oracle::relief_options(r, 128, Filter::c2, NormalMethod::blinn);
            const HeightField field(height, options.height_options, Filter::c2, 128, 128);
            const MethodError error = method_error(mesh_budget(height, field, options, target, Depth::float32));
            CHECK(error.largest_deg > 0);
            CHECK(error.largest_deg <= error.bound_deg);
            CHECK(error.bend == doctest::Approx(A / 0.4).epsilon(0.05)); // the tube's curvature
        }
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE(
        "method_error: on real meshes under real heights the error that is told is within a factor of 2 of that of "
        "the whole map, at every amplitude") {
        const auto data = test::shared_data();
        const HeightTexture height =
            read_height((data / "textures/pairs/ambientcg_Rock020/Rock020_1K_Displacement.jpg").string());
        for (const char* file : {"meshes/spot/spot_triangulated.obj", "meshes/leeperrysmith/LeePerrySmith.glb"}) {
            CAPTURE(std::string(file));
            const Mesh mesh = read_mesh((data / file).string());
            const double size = diagonal(bounds(mesh));
            const BakeTarget target = make_bake_target(mesh, file, 512, 512);
            for (const NormalMethod method : {NormalMethod::blinn, NormalMethod::constant_scale})
                for (const double part : {0.0005, 0.02}) {
                    if (method == NormalMethod::constant_scale && part > 0.001) continue; // off by 80 degrees
                    NormalMapOptions options;
                    options.width = options.height = 512, options.method = method;
                    options.height_options.amplitude = part * size;
                    const HeightField field(height, options.height_options, Filter::c2, 512, 512);
                    options.filter = Filter::c2;
                    const MethodError told = method_error(mesh_budget(height, field, options, target, Depth::float32));
                    const double measured = largest_difference(field, target, options);
                    MESSAGE(describe(told, method) << "; measured " << measured << ", at any slope " << told.bound_deg);
                    CHECK(measured / told.largest_deg < 2);
                    CHECK(measured / told.largest_deg > 0.5);
                }
        }
    }
}
