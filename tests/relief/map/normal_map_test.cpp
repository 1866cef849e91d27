#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "relief/map/torus_relief.h"
#include <cstring>
#include <doctest/doctest.h>

using namespace bake;
using oracle::relief_options;
using oracle::relief_texture;
using oracle::TorusRelief;

namespace {

oracle::Spread torus_error(const Mesh& mesh, const HeightTexture& height, const NormalMapOptions& options,
                           int bits = 0) {
    const BakeTarget target = make_bake_target(mesh, "torus", options.width, options.height);
    const HeightField field(height, options.height_options, options.filter, options.width, options.height);
    NormalMapReport report;
    const Image<float> map = normal_map(field, target, options, report);
    return oracle::spread(
        oracle::map_errors(map, target, bits, [](double u, double v) { return oracle::relief_normal({}, u, v); }));
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("normal_map: the torus relief on a fine mesh is right to 0.02 deg, and within the encoding's bound more "
              "at 8 and 16 bit") {
        const Mesh mesh = oracle::torus_mesh(1024, 512);
        const HeightTexture height = relief_texture({}, 1024);
        const NormalMapOptions options = relief_options({}, 1024, Filter::automatic);
        const oracle::Spread exact = torus_error(mesh, height, options);
        MESSAGE("float: mean " << exact.mean << ", p95 " << exact.p95 << ", max " << exact.max << " deg");
        CHECK(exact.mean <= 0.02);
        CHECK(exact.p95 <= 0.05);
        for (const int bits : {8, 16}) {
            const oracle::Spread stored = torus_error(mesh, height, options, bits);
            const double bound = glm::degrees(std::asin(std::sqrt(3.0) / (std::exp2(bits) - 1)));
            MESSAGE(bits << " bit: mean " << stored.mean << ", p95 " << stored.p95 << ", max " << stored.max
                         << " deg, bound " << bound);
            CHECK(stored.mean <= exact.mean + bound);
            CHECK(stored.p95 <= exact.p95 + bound);
            CHECK(stored.max <= exact.max + bound);
        }
    }

    TEST_CASE("normal_map: the torus relief on the plain 4096-triangle torus is right to 0.13 deg in the mean") {
        const oracle::Spread error = torus_error(oracle::torus_mesh(64, 32), relief_texture({}, 1024),
                                                 relief_options({}, 1024, Filter::automatic));
        MESSAGE("mean " << error.mean << ", p95 " << error.p95 << ", max " << error.max << " deg");
        CHECK(error.mean <= 0.13);
    }

    TEST_CASE("normal_map: with 8-bit heights the ranking of the filters reverses, and auto follows it") {
        const Mesh mesh = oracle::torus_mesh(256, 128);
        const auto mean = [&](int bits, Filter filter) {
            return torus_error(mesh, relief_texture({}, 1024, bits), relief_options({}, 1024, filter)).mean;
        };
        const double sobel8 = mean(8, Filter::sobel), central8 = mean(8, Filter::central),
                     fourth8 = mean(8, Filter::order4), sixth8 = mean(8, Filter::order6);
        MESSAGE("8 bit: sobel " << sobel8 << ", central " << central8 << ", order4 " << fourth8 << ", order6 " << sixth8
                                << " deg");
        CHECK(sobel8 < central8);
        CHECK(central8 < fourth8);
        CHECK(fourth8 < sixth8);
        CHECK(sobel8 == doctest::Approx(0.223).epsilon(0.1));
        CHECK(central8 == doctest::Approx(0.356).epsilon(0.1));
        CHECK(mean(8, Filter::automatic) == sobel8);
    }

    TEST_CASE("normal_map: with float heights the sharper filter is the better one, and auto takes the sharpest") {
        const TorusRelief r{0.001, 64, 64}; // 16 texels a period
        const HeightTexture height = relief_texture(r, 1024);
        const auto mean = [&](Filter filter) {
            const NormalMapOptions options = relief_options(r, 1024, filter);
            const Image<float> map =
                normal_map(HeightField(height, options.height_options, filter, 1024, 1024), {1, 1}, options);
            std::vector<double> errors;
            for (int y = 0; y < 1024; ++y)
                for (int x = 0; x < 1024; ++x) {
                    const Height<double> h = oracle::relief(r, (x + 0.5) / 1024, 1 - (y + 0.5) / 1024);
                    errors.push_back(oracle::angle_deg(
                        Vec3d(decode_normal({map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)}, false)),
                        {-h.b_u, -h.b_v, 1}));
                }
            return oracle::spread(errors).mean;
        };
        const double sobel = mean(Filter::sobel), central = mean(Filter::central), fourth = mean(Filter::order4),
                     spline = mean(Filter::c2);
        MESSAGE("float: sobel " << sobel << ", central " << central << ", order4 " << fourth << ", c2 " << spline
                                << " deg");
        CHECK(spline < fourth);
        CHECK(fourth < central);
        CHECK(central < sobel);
        CHECK(mean(Filter::automatic) == spline);
    }

    TEST_CASE("normal_map: on a plane every method gives the closed form, and extent sets the slope") {
        const TorusRelief r{0.01, 5, 3};
        const HeightTexture height = relief_texture(r, 256);
        const HeightField field(height, {.amplitude = 2 * r.A}, Filter::c2, 256, 256);
        for (const NormalMethod method : all_normal_methods) {
            NormalMapOptions options = relief_options(r, 256, Filter::c2, method);
            const Image<float> map = normal_map(field, {2, 0.5}, options);
            double worst = 0;
            for (int y = 0; y < 256; ++y)
                for (int x = 0; x < 256; ++x) {
                    const Height<double> h = oracle::relief(r, (x + 0.5) / 256, 1 - (y + 0.5) / 256);
                    const Vec3f t = decode_normal({map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)}, false);
                    worst = std::max(worst, oracle::angle_deg(Vec3d(t), {-h.b_u / 2, -h.b_v / 0.5, 1}));
                }
            CHECK(worst < 0.005);
        }
    }
}

TEST_SUITE("unit") {

    TEST_CASE("normal_map: a flat height gives (0.5, 0.5, 1) in every texel, covered or not") {
        HeightTexture height = relief_texture({}, 64);
        std::fill_n(height.values.data(), height.values.size(), 0.25f);
        const Mesh mesh = oracle::torus_mesh(16, 8);
        const NormalMapOptions options = relief_options({}, 64, Filter::automatic);
        const BakeTarget target = make_bake_target(mesh, "torus", 64, 64);
        const HeightField field(height, options.height_options, options.filter, 64, 64);
        for (const NormalMethod method : all_normal_methods) {
            NormalMapOptions chosen = options;
            chosen.method = method;
            NormalMapReport report;
            const Image<float> map = normal_map(field, target, chosen, report);
            for (std::size_t i = 0; i < map.size(); i += 3) {
                CHECK(map.data()[i] == 0.5f); // exactly: 8 bits must round it to 128 in every texel
                CHECK(map.data()[i + 1] == 0.5f);
                CHECK(std::abs(map.data()[i + 2] - 1) < 1e-6f);
            }
        }
    }

    TEST_CASE("normal_map: decode(encode(t)) is t, and DirectX is OpenGL with green turned over") {
        const Vec3f t = glm::normalize(Vec3f(0.3f, -0.4f, 0.8f));
        CHECK(glm::length(decode_normal(encode_normal(t, false), false) - t) < 1e-6f);
        CHECK(glm::length(decode_normal(encode_normal(t, true), true) - t) < 1e-6f);
        CHECK(encode_normal(t, true).y == doctest::Approx(1 - encode_normal(t, false).y));
    }

    TEST_CASE("normal_map: to_tangent_space inverts the shader's frame, whatever its lengths and angles") {
        for (const float sign : {1.0f, -1.0f}) {
            const Vec3f T(0.9f, 0.1f, -0.2f), N(0.1f, 0.2f, 0.85f), B = sign * glm::cross(N, T);
            const Vec3f t = glm::normalize(Vec3f(0.2f, -0.5f, 0.7f));
            const Vec3f world = t.x * T + t.y * B + t.z * N;
            CHECK(glm::length(to_tangent_space(3.0f * world, T, N, sign) - t) < 1e-5f);
        }
        CHECK(to_tangent_space(Vec3f(0, 0, 1), Vec3f(0), Vec3f(0, 0, 1), 1) == Vec3f(0));
    }

    TEST_CASE("normal_map: object space holds the normal itself") {
        const Mesh mesh = oracle::torus_mesh(256, 128);
        NormalMapOptions options = relief_options({}, 256, Filter::c2);
        options.space = Space::object;
        const HeightTexture height = relief_texture({}, 256);
        const BakeTarget target = make_bake_target(mesh, "torus", 256, 256);
        NormalMapReport report;
        const Image<float> map =
            normal_map(HeightField(height, options.height_options, options.filter, 256, 256), target, options, report);
        for (int i = 0; i < 256; i += 5) {
            const Vec3f n = decode_normal({map.at(i, i, 0), map.at(i, i, 1), map.at(i, i, 2)}, false);
            CHECK(oracle::angle_deg(Vec3d(n), oracle::relief_normal({}, (i + 0.5) / 256, 1 - (i + 0.5) / 256)) < 0.2);
        }
    }

    TEST_CASE("normal_map: a smaller map is the box-filtered height's, a larger one interpolates") {
        const TorusRelief r{0.01, 3, 2};
        const Mesh mesh = oracle::torus_mesh(256, 128);
        const HeightTexture height = relief_texture(r, 512);
        for (const Filter filter : {Filter::sobel, Filter::c2})
            for (const int size : {128, 300, 700}) {
                CAPTURE(size);
                const NormalMapOptions options = relief_options(r, size, filter);
                const BakeTarget target = make_bake_target(mesh, "torus", size, size);
                NormalMapReport report;
                const Image<float> map = normal_map(HeightField(height, options.height_options, filter, size, size),
                                                    target, options, report);
                const auto errors = oracle::map_errors(
                    map, target, 0, [&](double u, double v) { return oracle::relief_normal(r, u, v); });
                CHECK(oracle::spread(errors).mean < 0.05);
            }
    }

    TEST_CASE("pad_texels: fills up to the given distance from the nearest texel, the upper left one on ties") {
        Image<float> image(9, 7, 1);
        Image<unsigned char> owner(9, 7, 1);
        std::fill_n(image.data(), 63, 0.0f);
        std::fill_n(owner.data(), 63, static_cast<unsigned char>(0));
        image.at(2, 3) = 1, owner.at(2, 3) = 1;
        image.at(6, 3) = 2, owner.at(6, 3) = 1;
        CHECK(pad_texels(image, owner, 2) == 23); // two discs of 13 texels share one, and two are owned
        CHECK(image.at(4, 3) == 1);               // as far from both: the left one
        CHECK(image.at(5, 3) == 2);
        CHECK(image.at(2, 1) == 1);
        CHECK(image.at(1, 1) == 0); // sqrt 5 away
        CHECK(image.at(2, 0) == 0);
    }

    TEST_CASE("normal_map: the same bytes for 1, 2 and 7 threads") {
        const Mesh mesh = oracle::torus_mesh(64, 32);
        const HeightTexture height = relief_texture({}, 256, 8);
        const auto bake_with = [&](int threads) {
            const ThreadLimit limit(threads);
            const NormalMapOptions options = relief_options({}, 256, Filter::automatic);
            const BakeTarget target = make_bake_target(mesh, "torus", 256, 256);
            NormalMapReport report;
            return normal_map(HeightField(height, options.height_options, options.filter, 256, 256), target, options,
                              report);
        };
        const Image<float> one = bake_with(1);
        for (const int threads : {2, 7}) {
            const Image<float> more = bake_with(threads);
            CHECK(std::memcmp(one.data(), more.data(), one.size() * sizeof(float)) == 0);
        }
    }
}

TEST_SUITE("stability") {

    TEST_CASE("normal_map: relief rises outward on a mirrored chart") {
        Mesh mesh = oracle::torus_mesh(256, 128);
        for (Vec2f& uv : mesh.uvs) uv.x = 1 - uv.x;
        const TorusRelief r;
        const HeightTexture height = relief_texture(r, 512);
        const NormalMapOptions options = relief_options(r, 512, Filter::c2);
        const BakeTarget target = make_bake_target(mesh, "torus", 512, 512);
        NormalMapReport report;
        const Image<float> map =
            normal_map(HeightField(height, options.height_options, options.filter, 512, 512), target, options, report);
        // At chart (u, v) lies the torus's (1 - u, v), its height is the texture's at (u, v).
        const auto truth = [&](double u, double v) {
            Jet<double> s = oracle::unit_torus(1 - u, v);
            s.p_u = -s.p_u, s.n_u = -s.n_u;
            const Height<double> h = oracle::relief(r, u, v);
            return -glm::cross(s.p_u + h.b_u * s.n + h.b * s.n_u, s.p_v + h.b_v * s.n + h.b * s.n_v);
        };
        CHECK(oracle::spread(oracle::map_errors(map, target, 0, truth)).mean < 0.1);
        CHECK(report.folded == 0);
    }

    TEST_CASE("normal_map: a chart without area and a mesh without uvs are refused") {
        Mesh mesh = oracle::torus_mesh(8, 4);
        for (Vec2f& uv : mesh.uvs) uv = Vec2f(0.5f);
        CHECK_THROWS_AS(make_bake_target(mesh, "torus", 16, 16), Error);
        mesh.corner_uv.clear();
        CHECK_THROWS_AS(make_bake_target(mesh, "torus", 16, 16), Error);
    }

    TEST_CASE("normal_map: 1 x 1 and 1 x N maps hold finite normals") {
        const Mesh mesh = oracle::torus_mesh(16, 8);
        for (const auto& [width, height] : {std::pair(1, 1), {1, 9}, {9, 1}}) {
            const HeightTexture texture = relief_texture({}, 16, 8);
            NormalMapOptions options = relief_options({}, 1, Filter::automatic);
            const BakeTarget target = make_bake_target(mesh, "torus", width, height);
            NormalMapReport report;
            const Image<float> map = normal_map(
                HeightField(texture, options.height_options, options.filter, width, height), target, options, report);
            for (std::size_t i = 0; i < map.size(); ++i) CHECK((map.data()[i] >= 0 && map.data()[i] <= 1));
        }
    }

    TEST_CASE("normal_map: an amplitude beyond the radius of curvature is counted as folded, and gives no NaN") {
        const Mesh mesh = oracle::torus_mesh(64, 32);
        const HeightTexture height = relief_texture({}, 64);
        for (const double amplitude : {2.0, 1e6, -1e6}) {
            NormalMapOptions options = relief_options({}, 64, Filter::c2);
            options.height_options.amplitude = amplitude;
            const BakeTarget target = make_bake_target(mesh, "torus", 64, 64);
            NormalMapReport report;
            const Image<float> map = normal_map(HeightField(height, options.height_options, options.filter, 64, 64),
                                                target, options, report);
            CHECK(report.folded > 0);
            for (std::size_t i = 0; i < map.size(); ++i) CHECK((map.data()[i] >= 0 && map.data()[i] <= 1));
            // Blinn stands in, so no normal points inward, but for the little by which T and N are not perpendicular.
            float deepest = 1;
            for (std::size_t i = 2; i < map.size(); i += 3) deepest = std::min(deepest, map.data()[i]);
            CHECK(deepest > 0.45f);
        }
    }
}
