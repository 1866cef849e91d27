#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/displace/displace.h"
#include "bake/relief/displace/facet_loss.h"
#include "bake/surface/analytic/parametric_shapes.h"
#include "folders.h"
#include "relief/map/torus_relief.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

Relief waves(double amplitude, int periods) {
    Relief relief;
    relief.values = oracle::relief_texture({1, periods, periods}, 128).values;
    relief.height = {.amplitude = 2 * amplitude, .midlevel = 0.5};
    return relief;
}

struct Told {
    FacetLoss loss;
    double rms, max; ///< as measured
};

Told tell(const BaseSurface& base, const Relief& relief, int levels) {
    DisplaceOptions options;
    options.rates.levels = levels;
    options.measure_error = true;
    const Displaced displaced = displace(base, relief, options);
    return {facet_loss(displaced.mesh, relief), displaced.report.error_rms, displaced.report.error_max};
}

void check_within_two(const Told& told) {
    CAPTURE(told.loss.rms);
    CAPTURE(told.rms);
    CHECK(told.loss.rms / told.rms < 2);
    CHECK(told.loss.rms / told.rms > 0.5);
    CHECK(told.loss.max / told.max < 2);
    CHECK(told.loss.max / told.max > 0.5);
}

Mesh square() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.corner_position = mesh.corner_uv = {0, 1, 2, 3};
    mesh.face_begin = {0, 4};
    return mesh;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE(
        "facet_loss: edges of a square are as long as the texels that they span, and the relief has its own rms") {
        const BaseSurface base(square());
        const Told told = tell(base, waves(0.01, 2), 4);
        CHECK(told.loss.edge_texels == doctest::Approx(8));
        CHECK(told.loss.relief == doctest::Approx(0.005).epsilon(0.02)); // of sin sin: half the amplitude
        // sin(kx) over edges e: its interpolation is off by (k e)^2 / 8 at most, in either direction.
        const double ke = 2 * oracle::pi * 2 / 16;
        CHECK(told.loss.max == doctest::Approx(0.01 * ke * ke / 4).epsilon(0.25));
        check_within_two(told);
    }

    TEST_CASE("facet_loss: on a square and on a torus it is within a factor of 2 of the measured distance") {
        const BaseSurface flat(square());
        for (const int levels : {2, 3, 5}) check_within_two(tell(flat, waves(0.01, 3), levels));
        const BaseSurface torus{oracle::torus_mesh(16, 8)};
        for (const int levels : {0, 2}) check_within_two(tell(torus, waves(0.02, 8), levels));
    }

    TEST_CASE(
        "facet_loss: the part falls with the square of the edges, and is nearly all where waves fall between points") {
        const BaseSurface flat(square());
        const double coarse = tell(flat, waves(0.01, 2), 4).loss.part(),
                     fine = tell(flat, waves(0.01, 2), 5).loss.part();
        CHECK(coarse / fine == doctest::Approx(4).epsilon(0.1));
        CHECK(fine < smallest_seen_part);
        CHECK(tell(flat, waves(0.01, 16), 3).loss.part() > 0.9);
    }
}

TEST_SUITE("unit") {

    TEST_CASE("facet_loss: a flat height, vectors and meshes without uvs lose nothing") {
        Relief flat = waves(0.01, 2);
        std::fill(flat.values.data(), flat.values.data() + flat.values.size(), 0.75f);
        CHECK(facet_loss(square(), flat).part() < 1e-6);
        Relief vectors = waves(0.01, 2);
        vectors.vector = VectorSpace::object;
        CHECK(facet_loss(square(), vectors).rms == 0);
        Mesh bare = square();
        bare.corner_uv.clear();
        CHECK(facet_loss(bare, waves(0.01, 2)).rms == 0);
        CHECK(facet_loss(Mesh{}, waves(0.01, 2)).rms == 0);
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("facet_loss: on a real mesh under a real height it is within a factor of 2 of the measured distance") {
        const auto data = test::shared_data();
        Mesh mesh = read_mesh((data / "meshes/spot/spot_triangulated.obj").string());
        const double size = diagonal(bounds(mesh));
        const BaseSurface base(std::move(mesh));
        Relief relief;
        relief.values = read_height((data / "textures/heights/crater_dat.png").string()).values;
        relief.height = {.amplitude = 0.02 * size, .midlevel = 0.5};
        for (const int levels : {0}) {
            const Told told = tell(base, relief, levels);
            MESSAGE(told.loss.part() << " of the relief: rms " << told.loss.rms << ", measured " << told.rms);
            check_within_two(told);
        }
    }
}
